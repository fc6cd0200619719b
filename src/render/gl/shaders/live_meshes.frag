// Both sides of a triangle are lit alike.
uniform vec3 tint;
uniform bool clipped;

in vec3 place;
in vec3 facing;

out vec4 color;

void main() {
  if (clipped && dot(clip.xyz, place) > clip.w) discard;
  vec3 ray = normalize(place - eye.xyz);
  vec3 normal = normalize(facing);
  if (dot(normal, ray) > 0.0) normal = -normal;
  float toward = max(0.0, dot(normal, normalize(to_sun.xyz - ray)));
  float shine = toward * toward;
  shine *= shine;
  shine *= shine;
  color = vec4(lit(tint, normal, 0.12 * shine * shine * to_sun.w), 1.0);
}
