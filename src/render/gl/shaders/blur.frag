#version 330 core
// The mean over 4 x 4 pixels, which evens out the noise of the ambient light.
uniform sampler2D ambient;

out vec4 blurred;

void main() {
  ivec2 here = ivec2(gl_FragCoord.xy), last = textureSize(ambient, 0) - 1;
  float sum = 0.0;
  for (int y = -2; y < 2; ++y) {
    for (int x = -2; x < 2; ++x) sum += texelFetch(ambient, clamp(here + ivec2(x, y), ivec2(0), last), 0).x;
  }
  blurred = vec4(sum / 16.0);
}
