#version 330 core
// The surface of each pixel, from its samples: the nearest water, or the nearest other surface where none shows water.
uniform sampler2D depths;    // negative where water
uniform sampler2D colors;
uniform sampler2D normals;   // and, of water, how loose it is
uniform bool drops;          // whether loose water is told apart
uniform int samples;

out vec4 surface;            // depth (negative: water; 0: nothing); foam, and 2 more for drops, or body

float kind_at(ivec2 at) {
  bool drop = drops && texelFetch(normals, at, 0).w > 0.75;
  return texelFetch(colors, at, 0).a + (drop ? 2.0 : 0.0);
}

void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * samples;
  vec2 nearest = vec2(0.0);
  for (int y = 0; y < samples; ++y) {
    for (int x = 0; x < samples; ++x) {
      float depth = texelFetch(depths, first + ivec2(x, y), 0).x;
      bool nearer = nearest.x == 0.0 || (depth < 0.0 ? depth > nearest.x || nearest.x > 0.0
                                                     : nearest.x > 0.0 && depth < nearest.x);
      if (depth != 0.0 && nearer) nearest = vec2(depth, kind_at(first + ivec2(x, y)));
    }
  }
  surface = vec4(nearest, 0.0, 0.0);
}
