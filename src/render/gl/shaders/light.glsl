// The sun, the sky and the ground.
uniform sampler2DShadow sun_map;
uniform vec3 eye;
uniform mat3 to_view;            // right, up, back
uniform mat3 to_sun;             // of the sun's map
uniform vec3 to_light;           // unit vector to the sun
uniform vec3 sun_eye;
uniform vec3 sun_scale;          // from metres to the map, [-1, 1]; depth to [0, 1]
uniform float sun_blur;          // of shadows, m
uniform vec3 up;
uniform bool has_ground;
uniform float ground;            // its height, m
uniform float sky_light;         // brightness of the sky in the background
uniform vec3 action_center;
uniform float action_size;       // m
uniform float sphere_size;       // radius of a typical sphere, m
uniform float daylight;          // 1 by day

const vec3 kSun = vec3(1.60, 1.51, 1.38);
const vec3 kHorizon = vec3(0.12, 0.16, 0.21), kZenith = vec3(0.03, 0.05, 0.09);

// The sky in the background: dark, so that foam stands out.
vec3 sky(vec3 direction) {
  return sky_light * mix(kHorizon, kZenith, smoothstep(-0.05, 0.7, dot(direction, up)));
}

// The sky that surfaces mirror: bright, with a wide soft light around the sun.
vec3 mirrored_sky(vec3 direction) {
  vec3 color = mix(vec3(0.62, 0.70, 0.78), vec3(0.24, 0.36, 0.52), smoothstep(-0.05, 0.7, dot(direction, up)));
  float toward = max(0.0, dot(direction, to_light));
  float wide = toward * toward * toward;
  return color + vec3(1.0, 0.95, 0.85) * (0.35 * wide * wide + 0.8 * smoothstep(0.93, 1.0, toward));
}

// The share of the sun's light that arrives: the mean of `count` samples of the map, in a ring around the point.
float sunlight(vec3 point, float turn, int count) {
  vec3 at = (to_sun * (point - sun_eye)) * vec3(sun_scale.xy, -sun_scale.z);
  float light = 0.0;
  for (int i = 0; i < count; ++i) {
    float share = fract(turn + 0.618 * float(i));
    float angle = 6.2831853 * share;
    vec2 shift = sun_blur * (0.3 + 0.7 * fract(share * 7.0)) * vec2(cos(angle), sin(angle)) * sun_scale.xy;
    light += texture(sun_map, vec3(0.5 + 0.5 * (at.xy + shift), at.z));
  }
  return any(greaterThan(abs(at.xy), vec2(0.999))) || at.z > 1.0 ? 1.0 : light / float(count);
}

// Distance from a ball's surface at which its sunlight is looked up, so that it does not shadow itself, m: some pixels
// of the map.
float off_surface() { return 0.15 * sphere_size + 4.0 / (float(textureSize(sun_map, 0).x) * sun_scale.x); }

vec3 ground_color(vec3 point, float sun) {
  vec3 from = point - action_center;
  float away = length(from - dot(from, up) * up) / action_size;
  vec3 lit = vec3(0.095, 0.108, 0.125) * (0.3 + 0.7 * sun);
  return mix(lit, kHorizon, smoothstep(0.4, 3.0, away));
}

vec3 ground_point(vec3 from, vec3 direction) {
  return from - ((dot(from, up) - ground) / min(dot(direction, up), -1e-3)) * direction;
}

bool sees_ground(vec3 from, vec3 direction) {
  return has_ground && dot(direction, up) < -1e-3 && dot(from, up) > ground;
}

// Reflectance, from that of a surface seen straight on up to 1 at grazing angles (C. Schlick, 1994).
float mirror(float straight, float cosine) {
  float missing = 1.0 - cosine, square = missing * missing;
  return straight + (1.0 - straight) * square * square * missing;
}

// The sun's own reflection on a surface that is not quite smooth.
float highlight(vec3 normal, vec3 to_eye) {
  float cosine = max(0.0, dot(normal, normalize(to_eye + to_light)));
  float power = cosine * cosine;                                  // 2
  power *= power;                                                 // 4
  power *= power;                                                 // 8
  power *= power;                                                 // 16
  return 2.0 * power * power * power;
}

vec3 matte_light(vec3 normal, float sun, float sky_share) {
  vec3 around = mix(vec3(0.20, 0.19, 0.19), vec3(0.60, 0.68, 0.80), 0.5 + 0.5 * dot(normal, up)) * sky_share;
  return around + kSun * (max(0.0, dot(normal, to_light)) * sun);
}

// Bright light saturates gently; the root of the colour is stored, for more even steps.
vec4 stored(vec3 color) {
  color *= daylight;
  color = color * (1.0 + color / 5.0) / (1.0 + color);
  return vec4(sqrt(clamp(1.25 * color, 0.0, 1.0)), 1.0);
}
