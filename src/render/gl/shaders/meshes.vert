#version 330 core
// Triangles of a surface. Lengths in metres.
uniform vec3 eye;
uniform mat3 to_view;      // right, up, back
uniform vec2 clip_scale;   // from metres (at depth 1 where not parallel) to half a picture
uniform bool parallel;     // the sun's rays

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;

out vec3 view_position;
out vec3 view_normal;

void main() {
  view_position = to_view * (position - eye);
  view_normal = to_view * normal;
  gl_Position = parallel ? vec4(view_position.xy * clip_scale, 0.0, 1.0)
                         : vec4(view_position.xy * clip_scale, 0.0, -view_position.z);
}
