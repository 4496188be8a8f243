// Triptych anchor_arithmetic, version 1. FROZEN: never changed; see technique/anchors/shape.hpp.
// Eight chains of x * a + b in registers, with a and b that the compiler does not know.
layout(local_size_x = 64) in;
layout(std140) TRI_BINDING(0) uniform Anchor { uvec4 work; vec4 numbers; };  // turns; a, b
layout(std430) TRI_BINDING(1) writeonly buffer Results { uint results[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  float first = float(8u * i & 255u);
  vec4 x = first + vec4(0.0, 1.0, 2.0, 3.0);
  vec4 y = first + vec4(4.0, 5.0, 6.0, 7.0);
  float a = numbers.x;
  float b = numbers.y;
  for (uint turn = 0u; turn < work.x; ++turn) {
    x = x * a + b; y = y * a + b;
    x = x * a + b; y = y * a + b;
    x = x * a + b; y = y * a + b;
    x = x * a + b; y = y * a + b;
    x = x * a + b; y = y * a + b;
    x = x * a + b; y = y * a + b;
    x = x * a + b; y = y * a + b;
    x = x * a + b; y = y * a + b;
  }
  vec4 sum = x + y;
  results[i] = uint(sum.x + sum.y + sum.z + sum.w);
}
