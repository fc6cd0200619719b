// A few pixels for every particle.
layout(location = 0) in vec3 center;
layout(location = 1) in uint tag;      // as of live_balls.vert
uniform sampler2D materials;
uniform sampler2D colors;
uniform bool by_value;
uniform float pixels;                  // along each side of a point

flat out vec3 tint;

void main() {
  int material = int(tag >> 16u);
  float value = float(tag & 65535u) / 65535.0;
  vec3 v = to_view(center);
  bool hidden = tag == 0xffffffffu || dot(clip.xyz, center) > clip.w || -v.z < eye.w;
  tint = by_value ? texture(colors, vec2((value * 255.0 + 0.5) / 256.0, 0.5)).rgb
                  : mix(texelFetch(materials, ivec2(material, 0), 0).rgb, vec3(0.90, 0.96, 1.0),
                        value * texelFetch(materials, ivec2(material, 1), 0).r);
  gl_PointSize = pixels;
  gl_Position = hidden ? vec4(2.0, 2.0, 2.0, 1.0) : clip_position(v, -v.z);
}
