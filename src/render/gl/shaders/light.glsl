// The sun, the sky and the ground.
uniform sampler2DShadow sun_map;
uniform sampler2DShadow water_sun_map;  // how far the sun's light gets before it meets water
uniform bool has_water;
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
uniform int background;          // 0: a dark sky, 1: a bright one, 2: one colour
uniform vec3 background_color;   // as stored
uniform vec3 ground_tint;
uniform float sunlight_strength;  // 1 by default
uniform float skylight_strength;
uniform vec3 action_center;
uniform float action_size;       // m
uniform float sphere_size;       // radius of a typical sphere, m
uniform float daylight;          // 1 by day
uniform float brightest;         // light that is kept, in that of white

const vec3 kHorizon = vec3(0.12, 0.16, 0.21), kZenith = vec3(0.03, 0.05, 0.09);

vec3 sun_color() { return sunlight_strength * vec3(1.60, 1.51, 1.38); }

// Bright light saturates gently; the root of the colour is stored, for more even steps.
vec4 stored(vec3 color) {
  color *= daylight;
  color = color * (1.0 + color / 5.0) / (1.0 + color);
  return vec4(sqrt(clamp(1.25 * color, 0.0, brightest)), 1.0);
}

// The light of a stored colour.
vec3 unstored(vec3 root) {
  vec3 c = root * root / 1.25;  // c = x (1 + x / 5) / (1 + x)
  vec3 half_b = 2.5 * (c - 1.0);
  return (half_b + sqrt(half_b * half_b + 5.0 * c)) / max(daylight, 1e-3);
}

// The sky that surfaces mirror: bright, with a wide soft light around the sun.
vec3 mirrored_sky(vec3 direction) {
  vec3 color = mix(vec3(0.62, 0.70, 0.78), vec3(0.24, 0.36, 0.52), smoothstep(-0.05, 0.7, dot(direction, up)));
  float toward = max(0.0, dot(direction, to_light));
  float wide = toward * toward * toward;
  vec3 glare = vec3(1.0, 0.95, 0.85) * (0.35 * wide * wide + 0.8 * smoothstep(0.93, 1.0, toward));
  return skylight_strength * color + sunlight_strength * glare;
}

// The sky in the background: dark, so that foam stands out, or as it is mirrored, or one colour.
vec3 sky(vec3 direction) {
  if (background == 2) return unstored(background_color);
  if (background == 1) return mirrored_sky(direction);
  return sky_light * mix(kHorizon, kZenith, smoothstep(-0.05, 0.7, dot(direction, up)));
}

// What is mirrored or bent into view: the sky, and the ground below the horizon.
vec3 surroundings(vec3 direction) {
  float below = has_ground ? smoothstep(0.02, -0.25, dot(direction, up)) : 0.0;
  return mix(mirrored_sky(direction), 1.35 * ground_tint, below);
}

// The share of the sun's light that arrives past what `map` shows: the mean of `count` samples of it, in a ring around
// the point.
float light_past(sampler2DShadow map, vec3 point, float turn, int count) {
  vec3 at = (to_sun * (point - sun_eye)) * vec3(sun_scale.xy, -sun_scale.z);
  float light = 0.0;
  for (int i = 0; i < count; ++i) {
    float share = fract(turn + 0.618 * float(i));
    float angle = 6.2831853 * share;
    vec2 shift = sun_blur * (0.3 + 0.7 * fract(share * 7.0)) * vec2(cos(angle), sin(angle)) * sun_scale.xy;
    light += texture(map, vec3(0.5 + 0.5 * (at.xy + shift), at.z));
  }
  return any(greaterThan(abs(at.xy), vec2(0.999))) || at.z > 1.0 ? 1.0 : light / float(count);
}

float sunlight(vec3 point, float turn, int count) { return light_past(sun_map, point, turn, count); }
float water_sunlight(vec3 point, float turn, int count) {
  return has_water ? light_past(water_sun_map, point, turn, count) : 1.0;
}

// Water lets most of the sun's light through.
float softened_sunlight(vec3 point, float turn, int count) {
  return sunlight(point, turn, count) * mix(0.55, 1.0, water_sunlight(point, turn, (count + 1) / 2));
}

// Distance from a ball's surface at which its sunlight is looked up, so that it does not shadow itself, m: some pixels
// of the map.
float off_surface() { return 0.15 * sphere_size + 4.0 / (float(textureSize(sun_map, 0).x) * sun_scale.x); }

vec3 ground_color(vec3 point, float sun) {
  vec3 from = point - action_center;
  float away = length(from - dot(from, up) * up) / action_size;
  vec3 lit = ground_tint * (0.3 * skylight_strength + 0.7 * sunlight_strength * sun);
  vec3 level = normalize(point - eye);
  vec3 far = background == 0 ? kHorizon : sky(normalize(level - dot(level, up) * up));
  return mix(lit, far, smoothstep(0.4, 3.0, away));
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
  return skylight_strength * around + sun_color() * (max(0.0, dot(normal, to_light)) * sun);
}

// The light of an opaque surface; `albedo` as stored, `lift`: how far above it its sunlight is looked up, m.
vec3 solid_light(vec3 point, vec3 normal, vec3 to_eye, vec3 albedo, float roughness, float sky_share, float lift) {
  float sun = softened_sunlight(point + lift * (normal + to_light), noise(gl_FragCoord.xy), 1);
  vec3 color = albedo * albedo * matte_light(normal, sun, sky_share);
  float gloss = 1.0 - roughness;
  color += 0.26 * gloss * highlight(normal, to_eye) * sun * sun_color();
  float shine = gloss * mirror(0.04, max(0.0, dot(normal, to_eye)));
  return mix(color, mirrored_sky(reflect(-to_eye, normal)) * sky_share, shine);
}
