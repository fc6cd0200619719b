#version 330 core
// How far a pixel lies inside the outline of a smooth surface: the share of a disc around it that shows the same surface.
// Where that is below a half, the surface's spheres stick out of their mean outline.
uniform sampler2D surface;   // depth (negative: smooth; 0: nothing) and body
uniform bool bodies;         // whether other bodies are other surfaces
uniform float reach;         // radius of the disc, m
uniform float range;         // greatest difference in depth that belongs to the same surface, m
uniform float touching;      // greatest difference in depth to a solid that the surface touches, m
uniform float inset;         // how far the outline lies inside that of the spheres, as a share, before what is behind it
uniform float scale;         // pixels a metre at depth 1

out vec4 outline;            // the share; depth and body of the surface

const int kRing = 8;         // taps on the rim of the disc: where they all show the surface, the disc does
const int kTaps = 48;

ivec2 here, last;
vec2 front;                  // depth and body
float same, beside, behind;  // taps: that show the surface, or hide it; that show another body beside it; all others

void look(vec2 aside) {
  vec2 there = texelFetch(surface, clamp(here + ivec2(round(aside)), ivec2(0), last), 0).xy;
  bool smooth_there = there.x < 0.0, other = bodies && smooth_there && abs(there.y - front.y) > 0.5 / 255.0;
  float farther = there.x == 0.0 ? 1e30 : abs(there.x) - front.x;
  if (smooth_there && !other) {
    farther < range ? ++same : ++behind;
  } else if (other && abs(farther) < range) {
    ++beside;
  } else {
    farther < touching ? ++same : ++behind;
  }
}

void main() {
  here = ivec2(gl_FragCoord.xy);
  last = textureSize(surface, 0) - 1;
  vec2 own = texelFetch(surface, here, 0).xy;
  front = own.x < 0.0 ? vec2(-own.x, own.y) : vec2(0.0);
  if (own.x >= 0.0) {  // beside a surface: as far away as that
    for (int k = 0; k < 4; ++k) {
      ivec2 side = k < 2 ? ivec2(2 * k - 1, 0) : ivec2(0, 2 * k - 5);
      vec2 there = texelFetch(surface, clamp(here + side, ivec2(0), last), 0).xy;
      if (-there.x > front.x) front = vec2(-there.x, there.y);
    }
  }
  outline = vec4(0.0);
  if (front.x <= 0.0) return;
  float width = clamp(reach * scale / front.x, 1.5, 60.0);  // pixels
  same = beside = behind = 0.0;
  for (int tap = 0; tap < kRing; ++tap) {
    float angle = 6.2831853 * float(tap) / float(kRing);
    look(width * vec2(cos(angle), sin(angle)));
  }
  outline = vec4(1.0, front, 1.0);
  if (same == float(kRing) && own.x < 0.0) return;
  same = beside = behind = 0.0;
  vec2 toward = vec2(1.0, 0.0);
  for (int tap = 0; tap < kTaps; ++tap) {
    toward = mat2(-0.7374, 0.6755, -0.6755, -0.7374) * toward;  // by the golden angle
    look(width * sqrt((float(tap) + 0.5) / float(kTaps)) * toward);  // evenly over the disc
  }
  outline.x = same / float(kTaps) - inset * behind / max(beside + behind, 1.0);
}
