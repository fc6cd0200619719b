// The normal of the smoothed water.
uniform sampler2D surface;   // depth (negative: water, smoothed; 0: nothing) ; foam, and 2 more for drops, or body
uniform bool bodies;         // whether other bodies are other surfaces
uniform float range;         // a step in depth up to this belongs to the same surface, m

out vec4 water_normal;       // in view space, from [-1, 1] to [0, 1]

const float kNothing = 1e30;

vec2 own;

float depth_at(ivec2 pixel) {
  vec2 there = texelFetch(surface, clamp(pixel, ivec2(0), textureSize(surface, 0) - 1), 0).xy;
  bool same = there.x < 0.0 && (bodies ? abs(there.y - own.y) < 0.5 / 255.0 : (there.y >= 2.0) == (own.y >= 2.0));
  return same ? -there.x : kNothing;
}

// Direction of the surface towards `side`: the sum of the steps from behind and to ahead where both neighbours lie on
// the surface, else the one that does.
vec3 surface_step(ivec2 side, vec3 here) {
  vec2 at = gl_FragCoord.xy;
  ivec2 pixel = ivec2(at);
  vec3 ahead = view_point(at + vec2(side), depth_at(pixel + side)) - here;
  vec3 behind = here - view_point(at - vec2(side), depth_at(pixel - side));
  bool goes_on = abs(ahead.z) < range, comes_from = abs(behind.z) < range;
  if (goes_on && comes_from) return ahead + behind;
  return goes_on ? ahead : comes_from ? behind : vec3(vec2(side), 0.0);
}

void main() {
  own = texelFetch(surface, ivec2(gl_FragCoord.xy), 0).xy;
  water_normal = vec4(0.5, 0.5, 1.0, 1.0);
  if (own.x >= 0.0) return;
  vec3 here = view_point(gl_FragCoord.xy, -own.x);
  water_normal.xyz = 0.5 + 0.5 * normalize(cross(surface_step(ivec2(1, 0), here), surface_step(ivec2(0, 1), here)));
}
