#version 330 core
// A triangle for every sphere, between the eye and the sphere, that just covers its outline: one triangle is cheaper
// to set up than the two of a square. Lengths in metres.
uniform vec3 eye;
uniform mat3 to_view;      // right, up, back
uniform vec2 clip_scale;   // from metres (at depth 1 where not parallel) to half a picture
uniform bool parallel;     // the sun's rays

layout(location = 0) in vec3 center;
layout(location = 1) in float radius;
layout(location = 2) in vec4 color;
layout(location = 3) in float roughness;
layout(location = 4) in float body;       // of a skin; 0 for all else

flat out vec3 view_center;
flat out float view_radius;
flat out vec4 tint;        // alpha: foam, or the body
flat out float rough;
out vec3 offset;           // from the centre to a point of the triangle

void main() {
  vec2 corner = gl_VertexID == 0 ? vec2(-1.7320508, -1.0) : gl_VertexID == 1 ? vec2(1.7320508, -1.0) : vec2(0.0, 2.0);
  view_center = to_view * (center - eye);
  view_radius = radius;
  tint = vec4(color.rgb, max(color.a, body));
  rough = roughness;
  if (parallel) {
    offset = radius * vec3(corner, 1.0);
    gl_Position = vec4((view_center + offset).xy * clip_scale, 0.0, 1.0);
    return;
  }
  float d = length(view_center);
  vec3 ahead = view_center / d;
  float half_side = (d - radius) * radius / sqrt(max(d * d - radius * radius, 1e-20));
  vec3 u = normalize(cross(abs(ahead.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), ahead));
  vec3 v = cross(ahead, u);
  offset = -radius * ahead + half_side * (corner.x * u + corner.y * v);
  vec3 point = view_center + offset;
  // An eye inside a sphere does not see that sphere.
  gl_Position = d > radius ? vec4(point.xy * clip_scale, 0.0, -point.z) : vec4(2.0, 2.0, 2.0, 1.0);
}
