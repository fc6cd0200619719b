// The normal of the smoothed water.
uniform sampler2D surface;   // depth (negative: water, smoothed) and foam
uniform float range;         // a step in depth up to this belongs to the same surface, m

out vec4 water_normal;       // in view space, from [-1, 1] to [0, 1]

float depth_at(ivec2 pixel) { return abs(texelFetch(surface, pixel, 0).x); }

// Direction of the surface towards `side`: the sum of the steps from behind and to ahead where both neighbours lie on
// the surface, else the shorter step in depth.
vec3 surface_step(ivec2 side, vec3 here) {
  vec2 at = gl_FragCoord.xy;
  ivec2 pixel = ivec2(at);
  vec3 ahead = view_point(at + vec2(side), depth_at(pixel + side)) - here;
  vec3 behind = here - view_point(at - vec2(side), depth_at(pixel - side));
  if (abs(ahead.z) < range && abs(behind.z) < range) return ahead + behind;
  return abs(ahead.z) < abs(behind.z) ? ahead : behind;
}

void main() {
  vec3 here = view_point(gl_FragCoord.xy, depth_at(ivec2(gl_FragCoord.xy)));
  vec3 normal = normalize(cross(surface_step(ivec2(1, 0), here), surface_step(ivec2(0, 1), here)));
  water_normal = vec4(0.5 + 0.5 * normal, 1.0);
}
