#version 330 core
// A ribbon along an edge of the tank; its width is in pixels.
uniform vec3 eye;
uniform mat3 to_view;
uniform vec2 scale;
uniform vec2 picture;
uniform float width;      // pixels
uniform float nearest;

layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;

out float depth_ratio;    // 1 / depth: linear on the picture
noperspective out float across;

vec4 clip(vec3 p) { return vec4(p.xy * scale, 0.0, -p.z); }

void main() {
  vec3 a = to_view * (from - eye), b = to_view * (to - eye);
  // Cut off the part behind the eye.
  float limit = -2.0 * nearest;
  if (a.z > limit) a = mix(b, a, clamp((limit - b.z) / (a.z - b.z), 0.0, 1.0));
  if (b.z > limit) b = mix(a, b, clamp((limit - a.z) / (b.z - a.z), 0.0, 1.0));
  vec4 ca = clip(a), cb = clip(b);
  vec2 along = normalize((cb.xy / cb.w - ca.xy / ca.w) * picture + vec2(1e-9, 0.0));
  vec4 own = (gl_VertexID >> 1) == 0 ? ca : cb;
  across = float(gl_VertexID & 1) * 2.0 - 1.0;
  vec2 shift = across * width * vec2(-along.y, along.x) / picture;
  gl_Position = vec4(own.xy / own.w + shift, 0.0, 1.0);
  if (a.z > limit && b.z > limit) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  depth_ratio = 1.0 / own.w;
}
