#version 330 core
// Writes the same as spheres.frag, for triangles.
uniform float nearest;     // m
uniform vec3 tint;
uniform float roughness;

in vec3 view_position;
in vec3 view_normal;

layout(location = 0) out vec4 color;   // alpha 0: no foam
layout(location = 1) out vec4 normal;  // in view space, towards the eye, from [-1, 1] to [0, 1]; and roughness
layout(location = 2) out vec4 depth;   // m

void main() {
  float distance = -view_position.z;
  if (distance < nearest) discard;
  gl_FragDepth = nearest / distance;
  vec3 n = normalize(view_normal);
  if (dot(n, view_position) > 0.0) n = -n;
  color = vec4(tint, 0.0);
  normal = vec4(0.5 + 0.5 * n, roughness);
  depth = vec4(distance);
}
