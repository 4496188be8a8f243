// Writes first + factor·i to element i.
layout(local_size_x = 64) in;
layout(std430, binding = 0) writeonly buffer Numbers { uint numbers[]; };
uniform uvec2 line;

void main() {
  uint i = gl_GlobalInvocationID.x;
  numbers[i] = line.x + line.y * i;
}
