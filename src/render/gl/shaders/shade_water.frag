// Water, once a pixel: what lies behind, bent and coloured on its way through; the light that its depth sends back; the
// sky that it mirrors; and foam where it is mixed with air.
uniform sampler2D depths;        // of the spheres, several samples a pixel; negative where water
uniform sampler2D colors;        // of the spheres: the water's own colour
uniform sampler2D normals;       // of the spheres; and how loose they are: 1 a drop of its own
uniform sampler2D surface;       // smoothed: depth; foam, and 2 more for drops
uniform sampler2D water_normals;
uniform sampler2D ambient;
uniform sampler2D thickness;     // of the water along the view, m
uniform sampler2D behind;        // the picture without water
uniform sampler2D solids;        // its depth; 0 where it has none
uniform int samples;             // along each side of a pixel
uniform float water_scale;       // depth at which water takes its full colour, m
uniform float water_size;        // radius of a typical sphere of water, m

out vec4 shaded;

const vec3 kFoam = vec3(0.86, 0.91, 0.95);

// The sample of this pixel that shows water.
ivec2 water_sample(ivec2 pixel) {
  ivec2 first = pixel * samples;
  for (int y = 0; y < samples; ++y) {
    for (int x = 0; x < samples; ++x) {
      if (texelFetch(depths, first + ivec2(x, y), 0).x < 0.0) return first + ivec2(x, y);
    }
  }
  return first;
}

// The picture without water where the ray that enters at `at` has gone `length` metres, in view space.
vec3 picture_behind(vec3 at, vec3 ray, float length) {
  vec3 exit = at + length * ray;
  vec2 pixel = clamp(0.5 * picture + scale * exit.xy / max(-exit.z, 1e-6), vec2(0.5), picture - 0.5);
  float solid = texelFetch(solids, ivec2(pixel), 0).x;
  if (solid > 0.0 && solid < -at.z) pixel = gl_FragCoord.xy;  // something in front of the water
  return texture(behind, pixel / picture).rgb;
}

// The share of light that comes through `length` metres of water.
vec3 kept_through(vec3 albedo, float length) { return exp(-(1.05 - albedo) * (2.2 * length / water_scale)); }

// The light that so much water sends back.
vec3 depth_light(vec3 albedo, float length) {
  return albedo * mix(vec3(0.75, 1.0, 0.95), vec3(0.16, 0.30, 0.42), 1.0 - exp(-1.4 * length / water_scale));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec2 depth_and_foam = texelFetch(surface, pixel, 0).xy;
  shaded = vec4(0.0);
  if (depth_and_foam.x >= 0.0) return;
  float depth = -depth_and_foam.x, foam = depth_and_foam.y - (depth_and_foam.y >= 2.0 ? 2.0 : 0.0);
  vec2 place = gl_FragCoord.xy / picture;
  ivec2 water_at = water_sample(pixel);
  vec3 albedo = texelFetch(colors, water_at, 0).rgb;
  albedo *= albedo;  // about linear

  vec3 at = view_point(gl_FragCoord.xy, depth), ray = normalize(at);
  vec3 view_normal = normalize(texelFetch(water_normals, pixel, 0).xyz * 2.0 - 1.0);
  vec3 point = eye + at * to_view, to_eye = -ray * to_view, normal = view_normal * to_view;
  float solid = texelFetch(solids, pixel, 0).x;
  float through = texture(thickness, place).x;
  if (solid > depth) through = min(through, (solid - depth) / max(-ray.z, 0.1));
  float sky_share = texture(ambient, place).x;
  float turn = noise(gl_FragCoord.xy);
  vec3 lifted = point + 3.0 * water_size * (normal + to_light);
  float sun = sunlight(lifted, turn, 1) * mix(0.45, 1.0, water_sunlight(lifted, turn, 1));

  vec4 sphere = texelFetch(normals, water_at, 0);
  vec3 rough = normalize(sphere.xyz * 2.0 - 1.0) * to_view;
  float loose = sphere.w;

  // Through the water: red is lost first.
  vec3 inward = refract(ray, view_normal, 0.75);
  vec3 seen = unstored(picture_behind(at, inward, min(through, 6.0 * water_size + 0.25 * water_scale)));
  vec3 kept = kept_through(albedo, through), deep = depth_light(albedo, through);
  float lit = 0.45 + 0.55 * max(0.0, dot(normal, to_light)) * sun;
  // Behind a drop, the depth is that of the water which lies there.
  vec3 water_there = deep * (0.45 + 0.55 * max(0.0, dot(up, to_light))) + 0.15 * mirrored_sky(up);
  seen = mix(seen, water_there, loose * (1.0 - kept));
  float own = mix(through, min(through, 2.0 * water_size), loose);
  kept = mix(kept, kept_through(albedo, own), loose);
  vec3 color = seen * kept + deep * (1.0 - kept) * lit;

  float cosine = max(0.0, dot(normal, to_eye));
  vec3 mirrored = surroundings(reflect(-to_eye, normal)) * mix(0.5, 1.0, sky_share);
  color = mix(color, mirrored, mirror(0.02, cosine));
  color += highlight(normal, to_eye) * sun * 0.5 * sun_color();

  // Foam is matt, as uneven as the particles that carry it, and lit from within; of a thin layer of it much is seen
  // through.
  vec3 grain = normalize(mix(normal, rough, 0.2) + 0.5 * up);
  vec3 white = kFoam * matte_light(grain, sun, mix(0.6, 1.0, sky_share));
  float layer = 1.0 - exp(-through / (2.5 * water_size));
  shaded = stored(mix(color, white, 0.9 * foam * layer));
}
