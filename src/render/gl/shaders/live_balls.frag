// Where the ray of a pixel meets a sphere, computed relative to the sphere's centre.
layout(depth_less) out float gl_FragDepth;

flat in vec3 view_center;
flat in float view_radius;
flat in vec3 tint;
in vec3 offset;

out vec4 color;

void main() {
  vec3 ray = normalize(view_center + offset);
  float b = dot(offset, ray);
  float discriminant = b * b - dot(offset, offset) + view_radius * view_radius;
  if (discriminant < 0.0) discard;
  vec3 hit = offset - (b + sqrt(discriminant)) * ray;
  float depth = -(view_center + hit).z;
  if (depth < eye.w) discard;
  gl_FragDepth = stored_depth(depth);
  vec3 normal = from_view(hit / view_radius);
  float toward = max(0.0, dot(normal, normalize(to_sun.xyz - from_view(ray))));
  float shine = toward * toward;
  shine *= shine;
  shine *= shine;
  color = vec4(lit(tint, normal, 0.18 * shine * shine * to_sun.w), 1.0);
}
