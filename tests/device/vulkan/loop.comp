#version 450
// The least that shows whether a device ends a long loop early: each invocation counts to a number that
// the compiler cannot know.
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer In { uint wanted[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Out { uint counted[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  uint count = 0u;
  // Odd and even steps differ, so that no closed form replaces the loop.
  for (uint k = 0u; k < wanted[i]; ++k) count += (count & 1u) == (k & 1u) ? 1u : 0u;
  counted[i] = count;
}
