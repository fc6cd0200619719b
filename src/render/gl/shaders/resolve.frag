// The mean of each pixel's samples, as sRGB, with noise of one step against banding.
uniform sampler2D shaded;     // alpha 0 where a sample shows nothing
uniform sampler2D backdrop;   // shown where a sample shows nothing
uniform int samples;

out vec4 image;

void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * samples;
  vec3 behind = texelFetch(backdrop, ivec2(gl_FragCoord.xy), 0).rgb;
  vec3 sum = vec3(0.0);
  for (int y = 0; y < samples; ++y) {
    for (int x = 0; x < samples; ++x) {
      vec4 own = texelFetch(shaded, first + ivec2(x, y), 0);
      vec3 root = own.a == 0.0 ? behind : own.rgb;
      sum += root * root;
    }
  }
  vec3 linear = sum / float(samples * samples);
  vec3 encoded = mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, linear));
  image = vec4(encoded + (noise(gl_FragCoord.xy) - 0.5) / 255.0, 1.0);
}
