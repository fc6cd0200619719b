// Marks the pixels that particles are sure to cover, each with the depth of the particle's centre.
void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(count)) return;
  Footprint f = footprint(particles[i]);
  if (f.outside || f.large) return;
  ivec2 low = max(ivec2(ceil(f.middle - f.within - 0.5)), ivec2(0));
  ivec2 high = min(ivec2(floor(f.middle + f.within - 0.5)), ivec2(picture.xy) - 1);
  uint center = floatBitsToUint(f.center);
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      if (imageLoad(covers, ivec2(x, y)).r < center) imageAtomicMax(covers, ivec2(x, y), center);
    }
  }
}
