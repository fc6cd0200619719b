// An opaque ball.
uniform sampler2D depths;
uniform sampler2D colors;
uniform sampler2D normals;  // and roughness
uniform sampler2D ambient;

out vec4 shaded;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 at = view_point(gl_FragCoord.xy, texelFetch(depths, pixel, 0).x);
  vec4 surface = texelFetch(normals, pixel, 0);
  vec3 normal = normalize(surface.xyz * 2.0 - 1.0) * to_view;
  shaded = stored(solid_light(eye + at * to_view, normal, -normalize(at) * to_view, texelFetch(colors, pixel, 0).rgb,
                              surface.w, texture(ambient, gl_FragCoord.xy / picture).x, off_surface()));
}
