#version 330 core
// Where the ray of a sample meets a sphere. Computed relative to the sphere's centre: far from the eye, a ball may be
// smaller than the rounding error of its distance.
uniform float nearest;     // m
uniform float side;        // -1 for surfaces that are smoothed, else 1
uniform bool trimmed;      // whether what sticks out of the outline is left out
uniform bool bodies;       // whether alpha tells bodies apart
uniform sampler2D outline; // by pixel: share, depth and body of the foremost surface
uniform vec2 sample_picture;  // samples

flat in vec3 view_center;
flat in float view_radius;
flat in vec4 tint;
flat in float rough;
in vec3 offset;

layout(location = 0) out vec4 color;   // of the material, and its foam or body
layout(location = 1) out vec4 normal;  // in view space, from [-1, 1] to [0, 1]; and roughness
layout(location = 2) out vec4 depth;   // m; negative where it is smoothed: water and skin

// Whether this sample, at `distance`, belongs to a surface that ends before it. Water that is loose has no outline.
bool sticks_out(float distance) {
  vec2 place = gl_FragCoord.xy / sample_picture;
  vec2 front = texelFetch(outline, ivec2(place * vec2(textureSize(outline, 0))), 0).yz;
  bool other = front.x <= 0.0 || abs(distance - front.x) > 8.0 * view_radius ||
               (bodies && abs(front.y - tint.a) > 0.5 / 255.0);
  if (other) return false;
  vec2 pixel = 1.0 / vec2(textureSize(outline, 0));
  float share = 0.0;  // evened out over some pixels
  for (int k = 0; k < 4; ++k) share += 0.25 * texture(outline, place + pixel * vec2(2 * (k & 1) - 1, (k & 2) - 1)).x;
  return share < 0.5 * (bodies ? 1.0 : 1.0 - rough);
}

void main() {
  vec3 ray = normalize(view_center + offset);
  float b = dot(offset, ray);
  float discriminant = b * b - dot(offset, offset) + view_radius * view_radius;
  if (discriminant < 0.0) discard;
  vec3 hit = offset - (b + sqrt(discriminant)) * ray;
  float distance = -(view_center + hit).z;
  if (distance < nearest || (trimmed && sticks_out(distance))) discard;
  gl_FragDepth = nearest / distance;
  color = tint;
  normal = vec4(0.5 + 0.5 * hit / view_radius, rough);
  depth = vec4(side * distance);
}
