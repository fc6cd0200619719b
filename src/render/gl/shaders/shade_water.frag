// Water: light that comes through it from the ground, light that its depth sends back, the sky that it mirrors, and
// foam where it is fast or thin.
uniform sampler2D depths;
uniform sampler2D colors;
uniform sampler2D normals;       // of the spheres
uniform sampler2D surface;       // smoothed: depth and foam, by pixel
uniform sampler2D water_normals; // by pixel
uniform sampler2D ambient;       // by pixel
uniform sampler2D thickness;     // of the water along the view, m
uniform int samples;             // along each side of a pixel
uniform float water_scale;       // depth at which water takes its full colour, m

out vec4 shaded;

const vec3 kFoam = vec3(0.80, 0.88, 0.93);

void main() {
  ivec2 sample_at = ivec2(gl_FragCoord.xy), pixel = sample_at / samples;
  vec2 place = gl_FragCoord.xy / picture;
  float own = -texelFetch(depths, sample_at, 0).x;
  vec4 color_and_foam = texelFetch(colors, sample_at, 0);
  vec2 smoothed = texelFetch(surface, pixel, 0).xy;
  vec3 rough = normalize(texelFetch(normals, sample_at, 0).xyz * 2.0 - 1.0);
  // A drop before or behind the smooth surface of its pixel is drawn as a sphere.
  bool smooth_here = abs(smoothed.x + own) < 3.0 * sphere_size;
  float depth = smooth_here ? -smoothed.x : own;
  float foam = smooth_here ? smoothed.y : color_and_foam.a;
  vec3 normal = smooth_here ? normalize(texture(water_normals, place).xyz * 2.0 - 1.0) : rough;

  vec3 at = view_point(gl_FragCoord.xy, depth);
  vec3 point = eye + at * to_view, to_eye = -normalize(at) * to_view;
  normal = normal * to_view;
  rough = rough * to_view;
  vec3 albedo = color_and_foam.rgb * color_and_foam.rgb;  // about linear
  float sky_share = texture(ambient, place).x;
  float water = texture(thickness, place).x;
  float sun = sunlight(point + 1.5 * sphere_size * (normal + to_light), noise(gl_FragCoord.xy), 1);

  // What lies behind, through the water.
  vec3 inward = refract(-to_eye, normal, 0.75);
  vec3 behind = kHorizon;
  if (sees_ground(point, inward)) behind = ground_color(ground_point(point, inward), 0.2 + 0.5 * sun);
  behind *= vec3(0.55, 0.85, 1.0);
  vec3 through = exp(-(1.05 - albedo) * (2.2 * water / water_scale));
  float lit = 0.45 + 0.55 * max(0.0, dot(normal, to_light)) * sun;
  vec3 glow = albedo * mix(vec3(0.75, 1.0, 0.95), vec3(0.16, 0.30, 0.42), 1.0 - exp(-1.4 * water / water_scale));
  vec3 color = behind * through + glow * (1.0 - through) * lit * mix(0.55, 1.0, sky_share);

  vec3 mirrored = mirrored_sky(reflect(-to_eye, normal)) * mix(0.4, 1.0, sky_share);
  color = mix(color, mirrored, mirror(0.02, max(0.0, dot(normal, to_eye))));
  color += highlight(normal, to_eye) * sun * 0.12 * kSun;

  // Foam and drops: white, and rough as the balls are.
  float thin = 1.0 - smoothstep(1.0, 5.0, water / sphere_size);
  float white = clamp(foam + 0.55 * thin, 0.0, 0.85);
  vec3 grain = normalize(mix(normal, rough, 0.45));
  shaded = stored(mix(color, kFoam * matte_light(grain, sun, mix(0.5, 1.0, sky_share)), white));
}
