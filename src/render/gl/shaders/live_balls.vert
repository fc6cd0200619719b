// A triangle for every particle, between the eye and the sphere, that just covers its outline; its depth is that of the
// sphere's nearest point, so that hidden spheres are passed over before they are shaded.
layout(location = 0) in vec3 center;
layout(location = 1) in uint tag;      // material * 65536 + colour, 0 to 65535
uniform sampler2D materials;           // colour and radius; the second row: share of white for fast water
uniform sampler2D colors;              // of values
uniform bool by_value;

flat out vec3 view_center;
flat out float view_radius;
flat out vec3 tint;
out vec3 offset;                       // from the centre to a point of the triangle

void main() {
  int material = int(tag >> 16u);
  float value = float(tag & 65535u) / 65535.0;
  vec4 made = texelFetch(materials, ivec2(material, 0), 0);
  view_radius = made.w;
  view_center = to_view(center);
  float depth = -view_center.z;
  bool hidden = tag == 0xffffffffu || dot(clip.xyz, center) > clip.w || depth < -view_radius;
  if (hidden) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  if (by_value) {
    tint = texture(colors, vec2((value * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  } else {
    tint = mix(made.rgb, vec3(0.90, 0.96, 1.0), value * texelFetch(materials, ivec2(material, 1), 0).r);
  }
  vec2 corner = gl_VertexID == 0 ? vec2(-1.7320508, -1.0) : gl_VertexID == 1 ? vec2(1.7320508, -1.0) : vec2(0.0, 2.0);
  float d2 = dot(view_center, view_center), r2 = view_radius * view_radius;
  float d = sqrt(d2);
  vec3 ahead = view_center / d;
  float half_side = (d - view_radius) * view_radius * inversesqrt(max(d2 - r2, 1e-20));
  vec3 u = normalize(vec3(-ahead.z, 0.0, ahead.x) + vec3(1e-9, 0.0, 0.0));
  vec3 v = cross(ahead, u);
  offset = -view_radius * ahead + half_side * (corner.x * u + corner.y * v);
  vec3 point = view_center + offset;
  // An eye inside a sphere does not see that sphere.
  gl_Position = d > view_radius ? clip_position(point, max(depth - view_radius, eye.w)) : vec4(2.0, 2.0, 2.0, 1.0);
}
