// The smooth skin of a body, opaque.
uniform sampler2D depths;        // of the spheres; negative where skin
uniform sampler2D colors;
uniform sampler2D normals;       // of the spheres, and roughness
uniform sampler2D surface;       // smoothed: depth, by pixel
uniform sampler2D skin_normals;  // by pixel
uniform sampler2D ambient;
uniform int samples;             // along each side of a pixel
uniform float skin_size;         // radius of a typical sphere of skin, m

out vec4 shaded;

void main() {
  ivec2 sample_at = ivec2(gl_FragCoord.xy), pixel = sample_at / samples;
  float own = abs(texelFetch(depths, sample_at, 0).x), smoothed = -texelFetch(surface, pixel, 0).x;
  vec4 sphere = texelFetch(normals, sample_at, 0);
  // What lies before or behind the smooth surface of its pixel is drawn as a sphere.
  bool smooth_here = abs(smoothed - own) < 3.0 * skin_size;
  vec3 view_normal = smooth_here ? texelFetch(skin_normals, pixel, 0).xyz : sphere.xyz;
  vec3 normal = normalize(view_normal * 2.0 - 1.0) * to_view;
  vec3 at = view_point(gl_FragCoord.xy, smooth_here ? smoothed : own);
  shaded = stored(solid_light(eye + at * to_view, normal, -normalize(at) * to_view, texelFetch(colors, sample_at, 0).rgb,
                              sphere.w, texture(ambient, gl_FragCoord.xy / picture).x, off_surface() + 2.0 * skin_size));
}
