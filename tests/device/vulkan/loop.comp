#version 450
// The least that shows whether a device ends loops early: each invocation counts to a number that the
// compiler cannot know, by at most 1024 passes of a loop within another. Neither is long; a device that
// counts the passes of both together ends them all the same.
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
