// A thin sheet of glass, to be laid over what is behind it. Colours come multiplied by their alpha, and are squares of
// stored ones.
uniform float nearest;     // m
uniform float lead;        // how much nearer it counts, m: spheres of water that touch it reach through it
uniform vec3 tint;
uniform float opacity;
uniform float roughness;

in vec3 view_position;
in vec3 view_normal;

out vec4 glass;

void main() {
  float distance = -view_position.z;
  if (distance < nearest) discard;
  gl_FragDepth = min(nearest / max(distance - lead, nearest), 1.0);
  vec3 n = normalize(view_normal);
  if (dot(n, view_position) > 0.0) n = -n;
  vec3 normal = n * to_view, to_eye = -normalize(view_position) * to_view, point = eye + view_position * to_view;
  float cosine = max(0.0, dot(normal, to_eye));
  float mirrored_share = mirror(0.04, cosine) * (1.0 - 0.7 * roughness);
  vec3 mirrored = mix(surroundings(reflect(-to_eye, normal)), 0.7 * surroundings(normal), roughness);
  float sun = softened_sunlight(point + off_surface() * to_light, 0.5, 1);
  vec3 own = tint * tint * matte_light(normal, sun, 1.0);
  float alpha = 1.0 - (1.0 - opacity) * (1.0 - mirrored_share);
  vec3 color = (own * opacity * (1.0 - mirrored_share) + mirrored * mirrored_share) / max(alpha, 1e-4);
  vec3 root = stored(color).rgb;
  vec3 shine = stored(0.6 * (1.0 - roughness) * highlight(normal, to_eye) * sun * sun_color()).rgb;
  glass = vec4(root * root * alpha + shine * shine, alpha);
}
