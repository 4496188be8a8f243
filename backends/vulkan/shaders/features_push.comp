#version 450
// Copies a block of push constants of the size that every device must support (128 bytes).
layout(local_size_x = 32) in;
layout(std430, set = 0, binding = 0) writeonly buffer Numbers { uint numbers[]; };
layout(push_constant) uniform Push { uvec4 words[8]; };

void main() {
  uint i = gl_LocalInvocationIndex;
  numbers[i] = words[i / 4u][i % 4u];
}
