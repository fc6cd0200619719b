// How much of the sky reaches a surface past what is around it (M. McGuire et al., "The Alchemy screen-space ambient
// obscurance algorithm", 2011), at two reaches: between neighbours, and in the hollows of the whole. And the normal of
// the smoothed water.
uniform sampler2D surface;   // depth (negative: water, smoothed) and foam
uniform sampler2D normals;   // of the spheres
uniform int samples;         // of `normals` a pixel, along each side
uniform float reach;         // of the small shades, m
uniform float far_reach;     // of the large ones, m

layout(location = 0) out vec4 ambient;
layout(location = 1) out vec4 water_normal;  // in view space, from [-1, 1] to [0, 1]

const int kTaps = 4;

float depth_at(ivec2 pixel) { return abs(texelFetch(surface, pixel, 0).x); }

// How the surface goes on towards `side`: the mean of the steps from behind and to ahead where both lie on it, else the
// one that does.
vec3 surface_step(ivec2 side, vec3 here) {
  vec2 at = gl_FragCoord.xy;
  ivec2 pixel = ivec2(at);
  vec3 ahead = view_point(at + vec2(side), depth_at(pixel + side)) - here;
  vec3 behind = here - view_point(at - vec2(side), depth_at(pixel - side));
  float range = 4.0 * reach;
  if (abs(ahead.z) < range && abs(behind.z) < range) return ahead + behind;
  return abs(ahead.z) < abs(behind.z) ? ahead : behind;
}

float obscurance(vec3 here, vec3 normal, float radius, float turn, float bias) {
  float pixels = clamp(radius * scale / -here.z, 2.0, 0.12 * picture.y);
  float sum = 0.0;
  vec2 toward = vec2(cos(6.2831853 * turn), sin(6.2831853 * turn));
  for (int tap = 0; tap < kTaps; ++tap) {
    toward = mat2(-0.7374, 0.6755, -0.6755, -0.7374) * toward;  // by the golden angle
    float share = (float(tap) + 0.5) / float(kTaps);
    vec2 at = clamp(gl_FragCoord.xy + pixels * share * toward, vec2(0.5), picture - 0.5);
    float depth = depth_at(ivec2(at));
    vec3 to = view_point(floor(at) + 0.5, depth) - here;
    float square = dot(to, to);
    float near = depth > 0.0 ? max(0.0, 1.0 - square / (radius * radius)) : 0.0;
    sum += near * max(0.0, dot(to, normal) - bias * radius) * inversesqrt(square + 1e-12);
  }
  return sum / float(kTaps);
}

void main() {
  float depth = texelFetch(surface, ivec2(gl_FragCoord.xy), 0).x;
  vec3 here = view_point(gl_FragCoord.xy, abs(depth));
  vec3 normal = depth < 0.0
      ? normalize(cross(surface_step(ivec2(1, 0), here), surface_step(ivec2(0, 1), here)))
      : normalize(texelFetch(normals, ivec2(gl_FragCoord.xy) * samples + samples / 2, 0).xyz * 2.0 - 1.0);
  float turn = noise(gl_FragCoord.xy);
  float near = obscurance(here, normal, reach, turn, 0.05);
  float far = obscurance(here, normal, far_reach, turn, 0.02);
  ambient = vec4(depth == 0.0 ? 1.0 : clamp(1.0 - (depth < 0.0 ? 1.6 : 2.8) * near, 0.0, 1.0) * clamp(1.0 - 1.4 * far, 0.0, 1.0));
  water_normal = vec4(0.5 + 0.5 * normal, 1.0);
}
