// The ground and the sky behind everything.
uniform vec3 across;             // level unit vectors, along the ground's lines
uniform vec3 along;
uniform float line_step;         // m; 0: no lines

out vec4 shaded;

// The share of a pixel that the ground's lines take; a line lies at every whole number.
float lines(float place) {
  float width = max(fwidth(place), 1e-6);
  float from_line = abs(fract(place - 0.5) - 0.5) / width;
  return max(0.0, 1.0 - from_line) * clamp(0.25 / width - 1.0, 0.0, 1.0);
}

void main() {
  vec3 direction = normalize(view_point(gl_FragCoord.xy, 1.0)) * to_view;
  vec3 point = ground_point(eye, direction), from = point - action_center;
  vec3 color = sky(direction);
  if (sees_ground(eye, direction)) {
    color = ground_color(point, softened_sunlight(point + 0.02 * sphere_size * up, noise(gl_FragCoord.xy), 3));
    if (line_step > 0.0) {
      float line = max(lines(dot(from, across) / line_step), lines(dot(from, along) / line_step));
      color += (0.015 + 0.2 * ground_tint) * line * exp(-length(from) / action_size);
    }
  }
  shaded = stored(color);
}
