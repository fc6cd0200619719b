#version 330 core
// How far the sun's light gets before it meets a sphere.
uniform float range;       // depth of the map, m

flat in vec3 view_center;
flat in float view_radius;
in vec3 offset;

void main() {
  float height = view_radius * view_radius - dot(offset.xy, offset.xy);
  if (height < 0.0) discard;
  gl_FragDepth = -(view_center.z + sqrt(height)) / range;
}
