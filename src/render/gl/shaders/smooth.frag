#version 330 core
// Smooths the surface of water: a bell-weighted mean of the depths around a pixel, without depths that differ by more
// than a few radii (S. Green, "Screen space fluid rendering with point sprites", 2010; the narrow range after N. Truong
// and C. Yuksel, 2018). Other surfaces stay as they are.
uniform sampler2D surface;   // depth and foam
uniform float reach;         // how far bumps are smoothed, m
uniform float range;         // greatest difference in depth that still counts, m
uniform int taps;
uniform float scale;         // pixels a metre at depth 1

out vec4 smoothed;

void main() {
  ivec2 here = ivec2(gl_FragCoord.xy);
  vec2 own = texelFetch(surface, here, 0).xy;
  float width = clamp(reach * scale / max(-own.x, 1e-9), 1.5, 100.0);  // pixels
  vec2 sum = own;
  float weights = 1.0;
  vec2 toward = vec2(1.0, 0.0);
  for (int tap = 0; tap < taps; ++tap) {
    toward = mat2(-0.7374, 0.6755, -0.6755, -0.7374) * toward;  // by the golden angle
    float square = (float(tap) + 0.5) / float(taps);           // evenly over the disc
    vec2 other = texelFetch(surface, here + ivec2(round(width * sqrt(square) * toward)), 0).xy;
    float apart = (other.x - own.x) / range;
    float weight = other.x < 0.0 ? exp(-2.0 * square) * max(0.0, 1.0 - apart * apart) : 0.0;
    sum += weight * other;
    weights += weight;
  }
  smoothed = vec4(own.x < 0.0 ? sum / weights : own, 0.0, 0.0);
}
