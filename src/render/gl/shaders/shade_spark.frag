// A spark: shines by itself, white-hot in the middle, in its own colour towards the rim.
uniform sampler2D colors;
uniform sampler2D normals;

out vec4 shaded;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float facing = texelFetch(normals, pixel, 0).z * 2.0 - 1.0;
  vec3 own = texelFetch(colors, pixel, 0).rgb;
  float hot = facing * facing;
  shaded = vec4(mix(own, vec3(1.0), 0.45 * hot * hot) * (0.55 + 0.45 * hot), 1.0);
}
