// The picture from colours and depths: surfaces are darkened beside what stands out before them (eye-dome lighting,
// C. Boucheny, "Interactive scientific visualization of large datasets", 2009), and behind all of them lie ground and sky.
uniform sampler2D colors;
uniform sampler2D depths;

out vec4 shaded;

// How far the surface at another pixel stands before `depth`, in multiples of `unit`, as far as it counts. What stands
// far before casts no shade: a ball that flies has no dark rim around it.
float stands_before(vec2 at, float depth, float unit) {
  float before = (depth - eye.w / max(texture(depths, at).r, 1e-9)) / unit;
  return clamp(before, -2.0, 2.0) * (1.0 - smoothstep(3.0, 8.0, before));
}

// The same of both sides together: 0 on a plane, however it is inclined.
float hollow(vec2 at, vec2 aside, float depth, float unit) {
  return max(0.0, stands_before(at + aside, depth, unit) + stands_before(at - aside, depth, unit));
}

// The share of a pixel that lines take; a line lies at every whole number.
float lines(float place) {
  float width = max(fwidth(place), 1e-6);
  return max(0.0, 1.0 - abs(fract(place - 0.5) - 0.5) / width) * clamp(0.25 / width - 1.0, 0.0, 1.0);
}

vec3 backdrop(vec3 ray) {
  float high = smoothstep(-0.1, 0.7, dot(ray, sky_up.xyz));
  vec3 sky = picture.w > 0.5 ? mix(vec3(0.135, 0.155, 0.185), vec3(0.045, 0.055, 0.075), high)
                             : mix(vec3(0.86, 0.88, 0.90), vec3(0.70, 0.77, 0.85), high);
  float over = dot(eye.xyz, sky_up.xyz) - sky_up.w;
  float fall = -dot(ray, sky_up.xyz);
  if (picture.z < 0.5 || over <= 0.0 || fall < 1e-3) return sky;
  vec3 from = eye.xyz + (over / fall) * ray - action.xyz;
  float away = length(from - dot(from, sky_up.xyz) * sky_up.xyz) / action.w;
  vec3 across = normalize(abs(sky_up.y) > 0.5 ? cross(sky_up.xyz, vec3(0.0, 0.0, 1.0)) : cross(sky_up.xyz, vec3(0.0, 1.0, 0.0)));
  vec3 along = cross(across, sky_up.xyz);
  float step = exp2(floor(log2(action.w / 8.0)));
  float line = max(lines(dot(from, across) / step), lines(dot(from, along) / step));
  vec3 ground = picture.w > 0.5 ? vec3(0.105, 0.115, 0.130) : vec3(0.76, 0.78, 0.79);
  ground += (picture.w > 0.5 ? 0.05 : -0.06) * line * exp(-away);
  return mix(ground, sky, smoothstep(0.4, 3.0, away));
}

void main() {
  vec2 at = gl_FragCoord.xy / picture.xy;
  float kept = texture(depths, at).r;
  vec4 surface = texture(colors, at);
  if (kept <= 0.0) {
    vec2 place = 2.0 * at - 1.0;
    vec3 ray = normalize(from_view(vec3(place.x / right.w, place.y / up.w, -1.0)));
    shaded = vec4(mix(backdrop(ray), surface.rgb, surface.a), 1.0);
    return;
  }
  float dark = 0.0;
  if (balls.y > 0.0) {
    float depth = eye.w / kept;
    float unit = max(balls.x, 8.0 * depth / (up.w * picture.y));
    vec2 pixel = 1.0 / picture.xy;
    dark += hollow(at, pixel * vec2(2.0, 0.0), depth, unit) + hollow(at, pixel * vec2(0.0, 2.0), depth, unit);
    dark += hollow(at, pixel * vec2(5.0, 5.0), depth, unit) + hollow(at, pixel * vec2(5.0, -5.0), depth, unit);
  }
  shaded = vec4(surface.rgb * exp(-balls.y * dark), 1.0);
}
