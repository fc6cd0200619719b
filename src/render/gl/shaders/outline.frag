#version 330 core
// How far a pixel lies inside the outline of a skin: the share of a disc around it that shows the same skin. Where that is
// below a half, the skin's spheres stick out of their mean outline.
uniform sampler2D surface;   // depth (negative: skin; 0: nothing)
uniform float reach;         // radius of the disc, m
uniform float range;         // greatest difference in depth that belongs to the same skin, m
uniform float scale;         // pixels a metre at depth 1

out vec4 outline;

const int kTaps = 24;

void main() {
  ivec2 here = ivec2(gl_FragCoord.xy), last = textureSize(surface, 0) - 1;
  float own = texelFetch(surface, here, 0).x;
  float nearest = -own;
  if (own >= 0.0) {  // beside a skin: as far away as that
    nearest = 0.0;
    for (int k = 0; k < 4; ++k) {
      ivec2 side = k < 2 ? ivec2(2 * k - 1, 0) : ivec2(0, 2 * k - 5);
      nearest = max(nearest, -texelFetch(surface, clamp(here + side, ivec2(0), last), 0).x);
    }
  }
  outline = vec4(0.0);
  if (nearest <= 0.0) return;
  float width = clamp(reach * scale / nearest, 1.5, 60.0);  // pixels
  vec2 toward = vec2(1.0, 0.0);
  for (int tap = 0; tap < kTaps; ++tap) {
    toward = mat2(-0.7374, 0.6755, -0.6755, -0.7374) * toward;  // by the golden angle
    float share = sqrt((float(tap) + 0.5) / float(kTaps));      // evenly over the disc
    float depth = -texelFetch(surface, clamp(here + ivec2(round(width * share * toward)), ivec2(0), last), 0).x;
    if (depth > 0.0 && abs(depth - nearest) < range) outline.x += 1.0 / float(kTaps);
  }
}
