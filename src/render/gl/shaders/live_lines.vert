// Lines of the tank, of the grid and of forces.
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color;

out vec4 tint;

void main() {
  tint = color;
  vec3 v = to_view(position);
  gl_Position = vec4(v.x * right.w, v.y * up.w, 2.0 * eye.w + v.z, -v.z);
}
