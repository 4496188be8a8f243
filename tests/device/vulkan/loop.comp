#version 450
// The smallest shader that shows whether a device ends loops early. Each invocation counts to a number
// that the compiler does not know, in an outer loop around an inner loop of at most 1024 iterations.
// Neither loop is long, but a device that limits the iterations of both together still ends them.
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer In { uint wanted[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Out { uint counted[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  uint count = 0u;
  // Odd and even steps differ, so that no closed form replaces the loop.
  uint k = 0u;
  while (k < wanted[i]) {
    uint end = min(k + 1024u, wanted[i]);
    for (; k < end; ++k) count += (count & 1u) == (k & 1u) ? 1u : 0u;
  }
  counted[i] = count;
}
