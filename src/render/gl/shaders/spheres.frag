#version 330 core
// Where the ray of a sample meets a sphere. Computed relative to the sphere's centre: far from the eye, a ball may be
// smaller than the rounding error of its distance.
uniform float nearest;     // m
uniform float side;        // -1 for surfaces that are smoothed, else 1
uniform bool trimmed;      // whether what sticks out of the skin's outline is left out
uniform sampler2D outline; // by pixel
uniform sampler2D surface; // by pixel: depth of the foremost skin, negative
uniform vec2 sample_picture;  // samples

flat in vec3 view_center;
flat in float view_radius;
flat in vec4 tint;
flat in float rough;
in vec3 offset;

layout(location = 0) out vec4 color;   // of the material, and its foam
layout(location = 1) out vec4 normal;  // in view space, from [-1, 1] to [0, 1]; and roughness
layout(location = 2) out vec4 depth;   // m; negative where it is smoothed: water and skin

// Whether this sample, at `distance`, belongs to a skin that ends before it.
bool sticks_out(float distance) {
  vec2 place = gl_FragCoord.xy / sample_picture;
  float front = -texelFetch(surface, ivec2(place * vec2(textureSize(surface, 0))), 0).x;
  return texture(outline, place).x < 0.5 && front > 0.0 && abs(distance - front) < 3.0 * view_radius;
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
