#version 330 core
// The surface of each pixel, from its samples: the nearest water, or the nearest other surface where none shows water.
uniform sampler2D depths;    // negative where water
uniform sampler2D colors;
uniform int samples;

out vec4 surface;            // depth (negative: water; 0: nothing) and foam

void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * samples;
  vec2 nearest = vec2(0.0);
  for (int y = 0; y < samples; ++y) {
    for (int x = 0; x < samples; ++x) {
      float depth = texelFetch(depths, first + ivec2(x, y), 0).x;
      bool nearer = nearest.x == 0.0 || (depth < 0.0 ? depth > nearest.x || nearest.x > 0.0
                                                     : nearest.x > 0.0 && depth < nearest.x);
      if (depth != 0.0 && nearer) nearest = vec2(depth, texelFetch(colors, first + ivec2(x, y), 0).a);
    }
  }
  surface = vec4(nearest, 0.0, 0.0);
}
