#version 450
// Writes first + factor·i to element i.
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) writeonly buffer Numbers { uint numbers[]; };
layout(push_constant) uniform Push { uint first; uint factor; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  numbers[i] = first + factor * i;
}
