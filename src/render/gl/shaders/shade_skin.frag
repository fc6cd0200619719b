// The smooth skin of a body, opaque.
uniform sampler2D depths;        // of the spheres; negative where skin
uniform sampler2D colors;        // and bodies
uniform sampler2D normals;       // of the spheres, and roughness
uniform sampler2D surface;       // smoothed, by pixel: depth and body
uniform sampler2D skin_normals;  // by pixel
uniform sampler2D ambient;
uniform int samples;             // along each side of a pixel
uniform float skin_size;         // radius of a typical sphere of skin, m

out vec4 shaded;

// The smooth surface that a sample belongs to: that of its pixel, or of one beside it where the pixel shows another one.
// Depth and body; the depth is 0 where there is none.
float smooth_depth(ivec2 pixel, float own, float body, out ivec2 found) {
  for (int k = 0; k < 5; ++k) {
    found = clamp(pixel + ivec2((k & 1) * (2 - k), (k & 1) == 0 && k > 0 ? k - 3 : 0), ivec2(0),
                  textureSize(surface, 0) - 1);
    vec2 there = texelFetch(surface, found, 0).xy;
    if (there.x < 0.0 && abs(there.x + own) < 3.0 * skin_size && abs(there.y - body) < 0.5 / 255.0) return -there.x;
  }
  return 0.0;
}

void main() {
  ivec2 sample_at = ivec2(gl_FragCoord.xy), found;
  vec4 color = texelFetch(colors, sample_at, 0), sphere = texelFetch(normals, sample_at, 0);
  float own = abs(texelFetch(depths, sample_at, 0).x);
  float smoothed = smooth_depth(sample_at / samples, own, color.a, found);
  // What lies before or behind the smooth surface is drawn as a sphere.
  vec3 view_normal = smoothed > 0.0 ? texelFetch(skin_normals, found, 0).xyz : sphere.xyz;
  vec3 normal = normalize(view_normal * 2.0 - 1.0) * to_view;
  vec3 at = view_point(gl_FragCoord.xy, smoothed > 0.0 ? smoothed : own), to_eye = -normalize(at) * to_view;
  // At its outline, a lattice's normals are uncertain: they do not turn far enough from the eye to mirror all of the sky.
  normal = normalize(normal + max(0.0, 0.3 - dot(normal, to_eye)) * to_eye);
  shaded = stored(solid_light(eye + at * to_view, normal, to_eye, color.rgb, sphere.w,
                              texture(ambient, gl_FragCoord.xy / picture).x, off_surface() + 2.0 * skin_size));
}
