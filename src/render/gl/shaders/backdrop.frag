// The ground and the sky, where nothing is before them.
out vec4 shaded;

void main() {
  vec3 direction = normalize(view_point(gl_FragCoord.xy, 1.0)) * to_view;
  vec3 color = sky(direction);
  if (sees_ground(eye, direction)) {
    vec3 point = ground_point(eye, direction);
    color = ground_color(point, sunlight(point + 0.02 * sphere_size * up, noise(gl_FragCoord.xy), 4));
  }
  shaded = stored(color);
}
