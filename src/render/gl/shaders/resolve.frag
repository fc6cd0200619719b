// The mean of each pixel's samples. The last picture is sRGB, with noise of one step against banding, or linear light
// multiplied by alpha; the one that water lets through stays a root, as colours are stored.
uniform sampler2D shaded;     // alpha 0 where a sample shows nothing
uniform sampler2D backdrop;   // shown where a sample shows nothing
uniform sampler2D depths;     // of the samples; negative where water
uniform sampler2D water;      // shown where a sample shows water
uniform sampler2D glass;      // over all that, multiplied by its alpha
uniform bool has_glass;
uniform int samples;
uniform bool last;
uniform bool linear_light;    // whether the last picture is not sRGB
uniform float brightest;      // light that is kept, in that of white
uniform bool transparent;     // whether the last picture's alpha tells where it shows something

out vec4 image;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), first = pixel * samples;
  vec3 empty = texelFetch(backdrop, pixel, 0).rgb, wet = texelFetch(water, pixel, 0).rgb;
  vec3 sum = vec3(0.0);
  float covered = 0.0;
  for (int y = 0; y < samples; ++y) {
    for (int x = 0; x < samples; ++x) {
      ivec2 at = first + ivec2(x, y);
      vec4 own = texelFetch(shaded, at, 0);
      bool is_wet = texelFetch(depths, at, 0).x < 0.0;
      vec3 root = is_wet ? wet : own.a == 0.0 ? empty : own.rgb;
      float solid = transparent && !is_wet && own.a == 0.0 ? 0.0 : 1.0;
      vec4 over = has_glass ? texelFetch(glass, at, 0) : vec4(0.0);
      sum += over.rgb + (1.0 - over.a) * solid * root * root;
      covered += over.a + (1.0 - over.a) * solid;
    }
  }
  float alpha = covered / float(samples * samples);
  vec3 linear = min(sum / max(covered, 1e-3), vec3(brightest));
  if (!last) {
    image = vec4(sqrt(linear), 1.0);
    return;
  }
  if (linear_light) {
    image = vec4(linear * alpha, alpha);
    return;
  }
  vec3 encoded = mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, linear));
  image = vec4(encoded + (noise(gl_FragCoord.xy) - 0.5) / 255.0, alpha);
}
