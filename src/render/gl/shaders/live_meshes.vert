// Triangles of colliders and cloths.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;

out vec3 place;
out vec3 facing;

void main() {
  place = position;
  facing = normal;
  vec3 v = to_view(position);
  gl_Position = clip_position(v, -v.z);
}
