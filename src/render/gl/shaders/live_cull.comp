// Lists the particles of which something may be seen.
layout(std430, binding = 1) writeonly buffer Seen { vec4 seen[]; };
layout(std430, binding = 2) buffer Draw { uint vertex_count, instance_count, first_vertex, first_instance; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(count)) return;
  vec4 particle = particles[i];
  Footprint f = footprint(particle);
  if (f.outside || (!f.large && is_covered(f))) return;
  seen[atomicAdd(instance_count, 1u)] = particle;
}
