#version 330 core
// An edge of the tank, where nothing lies before it.
uniform sampler2D depths;     // several samples a pixel
uniform int samples;
uniform vec3 color;
uniform float opacity;

in float depth_ratio;
noperspective in float across;

out vec4 shaded;

void main() {
  float depth = abs(texelFetch(depths, ivec2(gl_FragCoord.xy) * samples, 0).x);
  bool covered = depth > 0.0 && depth * depth_ratio < 0.9995;
  float edge = 1.0 - smoothstep(0.4, 1.0, abs(across));
  shaded = vec4(color, opacity * edge * (covered ? 0.0 : 1.0));
}
