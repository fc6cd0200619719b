// Where a particle falls on the picture, for the passes that find out which particles can be seen.
layout(local_size_x = 64) in;
layout(r32ui, binding = 0) uniform uimage2D covers;   // bits of the stored depth of what is known to cover a pixel
layout(std430, binding = 0) readonly buffer Particles { vec4 particles[]; };   // w: bits of the tag
uniform sampler2D materials;
uniform int count;

const int kLargest = 12;   // radius of particles that are looked at closely, pixels; larger ones count as seen

struct Footprint {
  bool outside;            // of the picture, or left out
  bool large;
  vec2 middle;             // pixels
  float radius;            // pixels, of what may be seen of it
  float front, center;     // stored depths of the nearest point and of the centre
  float within;            // half the edge of a square of pixels that it covers, pixels
};

Footprint footprint(vec4 particle) {
  Footprint f;
  uint tag = floatBitsToUint(particle.w);
  vec3 v = to_view(particle.xyz);
  float radius = texelFetch(materials, ivec2(int(tag >> 16u), 0), 0).w, depth = -v.z;
  f.outside = tag == 0xffffffffu || dot(clip.xyz, particle.xyz) > clip.w || depth < -radius;
  f.large = true;
  if (f.outside) return f;
  float from = depth - radius;
  if (from <= 2.0 * eye.w + radius) return f;
  float pixels = 0.5 * up.w * picture.y;
  f.middle = 0.5 * picture.xy + pixels * v.xy / depth;
  // A little more than the ellipse as which a sphere is seen.
  f.radius = pixels * radius / from * (1.0 + dot(v.xy, v.xy) / (depth * depth)) + 1.0;
  f.within = 0.7 * pixels * radius / depth;
  f.front = stored_depth(from);
  f.center = stored_depth(depth);
  f.large = f.radius > float(kLargest);
  f.outside = any(lessThan(f.middle + f.radius, vec2(0.0))) || any(greaterThan(f.middle - f.radius, picture.xy));
  return f;
}

bool is_covered(Footprint f) {
  ivec2 low = max(ivec2(ceil(f.middle - f.radius - 0.5)), ivec2(0));
  ivec2 high = min(ivec2(floor(f.middle + f.radius - 0.5)), ivec2(picture.xy) - 1);
  uint front = floatBitsToUint(f.front);
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      if (imageLoad(covers, ivec2(x, y)).r <= front) return false;
    }
  }
  return true;
}
