#version 330 core
// The nearest of each pixel's samples: depth (negative: water) and foam.
uniform sampler2D depths;
uniform sampler2D colors;
uniform int samples;

out vec4 surface;

void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * samples;
  vec2 nearest = vec2(0.0);
  for (int y = 0; y < samples; ++y) {
    for (int x = 0; x < samples; ++x) {
      float depth = texelFetch(depths, first + ivec2(x, y), 0).x;
      bool nearer = depth != 0.0 && (nearest.x == 0.0 || abs(depth) < abs(nearest.x));
      if (nearer) nearest = vec2(depth, texelFetch(colors, first + ivec2(x, y), 0).a);
    }
  }
  surface = vec4(nearest, 0.0, 0.0);
}
