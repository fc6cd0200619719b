// An opaque ball.
uniform sampler2D depths;
uniform sampler2D colors;
uniform sampler2D normals;
uniform sampler2D ambient;

out vec4 shaded;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 at = view_point(gl_FragCoord.xy, texelFetch(depths, pixel, 0).x);
  vec3 point = eye + at * to_view, to_eye = -normalize(at) * to_view;
  vec3 normal = normalize(texelFetch(normals, pixel, 0).xyz * 2.0 - 1.0) * to_view;
  vec3 albedo = texelFetch(colors, pixel, 0).rgb;
  albedo *= albedo;  // about linear
  float sky_share = texture(ambient, gl_FragCoord.xy / picture).x;
  float sun = sunlight(point + off_surface() * (normal + to_light), noise(gl_FragCoord.xy), 1);
  vec3 color = albedo * matte_light(normal, sun, sky_share);
  color += 0.13 * highlight(normal, to_eye) * sun * kSun;
  float shine = 0.5 * mirror(0.04, max(0.0, dot(normal, to_eye)));
  shaded = stored(mix(color, mirrored_sky(reflect(-to_eye, normal)) * sky_share, shine));
}
