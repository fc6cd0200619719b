// The share of the sky's light that reaches a surface past its surroundings (M. McGuire et al., "The Alchemy
// screen-space ambient obscurance algorithm", 2011), at two reaches: between neighbours, and in large hollows. For
// every second pixel along each side.
uniform sampler2D surface;   // depth (negative: water, smoothed) and foam
uniform sampler2D normals;   // of the spheres
uniform sampler2D water_normals;
uniform int samples;         // of `normals`, along each side of a pixel
uniform float reach;         // of the small shades, m
uniform float far_reach;     // of the large ones, m

out vec4 ambient;

const int kTaps = 5;

float depth_at(ivec2 pixel) { return abs(texelFetch(surface, pixel, 0).x); }

float obscurance(vec2 pixel, vec3 here, vec3 normal, float radius, float turn, float bias) {
  float pixels = clamp(radius * scale / -here.z, 2.0, 0.12 * picture.y);
  float sum = 0.0;
  vec2 toward = vec2(cos(6.2831853 * turn), sin(6.2831853 * turn));
  for (int tap = 0; tap < kTaps; ++tap) {
    toward = mat2(-0.7374, 0.6755, -0.6755, -0.7374) * toward;  // by the golden angle
    float share = (float(tap) + 0.5) / float(kTaps);
    vec2 at = clamp(pixel + pixels * share * toward, vec2(0.5), picture - 0.5);
    float depth = depth_at(ivec2(at));
    vec3 to = view_point(floor(at) + 0.5, depth) - here;
    float square = dot(to, to);
    float near = depth > 0.0 ? max(0.0, 1.0 - square / (radius * radius)) : 0.0;
    sum += near * max(0.0, dot(to, normal) - bias * radius) * inversesqrt(square + 1e-12);
  }
  return sum / float(kTaps);
}

void main() {
  vec2 at = min(floor(gl_FragCoord.xy) * 2.0 + 0.5, picture - 0.5);
  ivec2 pixel = ivec2(at);
  float depth = texelFetch(surface, pixel, 0).x;
  vec3 here = view_point(at, abs(depth));
  vec3 stored_normal = depth < 0.0 ? texelFetch(water_normals, pixel, 0).xyz
                                   : texelFetch(normals, pixel * samples + samples / 2, 0).xyz;
  vec3 normal = normalize(stored_normal * 2.0 - 1.0);
  float turn = noise(gl_FragCoord.xy);
  float near = obscurance(at, here, normal, reach, turn, 0.05);
  float far = obscurance(at, here, normal, far_reach, turn, 0.02);
  float strength = depth < 0.0 ? 1.6 : 2.8;
  ambient = vec4(depth == 0.0 ? 1.0 : clamp(1.0 - strength * near, 0.0, 1.0) * clamp(1.0 - 1.4 * far, 0.0, 1.0));
}
