// Triptych anchor_arithmetic, version 1. FROZEN: never changed; see technique/anchors/shape.hpp.
// Sixty-four chains of x * a + b in registers, with a and b that the compiler does not know.
#pragma OPENCL FP_CONTRACT ON

#define TRI_STEP                                                  \
  x0 = x0 * a + b; x1 = x1 * a + b; x2 = x2 * a + b; x3 = x3 * a + b; \
  x4 = x4 * a + b; x5 = x5 * a + b; x6 = x6 * a + b; x7 = x7 * a + b;

__kernel __attribute__((reqd_work_group_size(64, 1, 1))) void anchor_arithmetic(
    uint4 work, float4 numbers, __global uint* results) {  // turns; a, b
  uint i = (uint)get_global_id(0);
  float8 x0 = (float)(64u * i & 255u) + (float8)(0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f);
  float8 x1 = x0 + 8.0f;
  float8 x2 = x0 + 16.0f;
  float8 x3 = x0 + 24.0f;
  float8 x4 = x0 + 32.0f;
  float8 x5 = x0 + 40.0f;
  float8 x6 = x0 + 48.0f;
  float8 x7 = x0 + 56.0f;
  float a = numbers.x;
  float b = numbers.y;
  for (uint turn = 0u; turn < work.x; ++turn) {
    TRI_STEP TRI_STEP TRI_STEP TRI_STEP TRI_STEP TRI_STEP TRI_STEP TRI_STEP
  }
  float8 sum = ((x0 + x1) + (x2 + x3)) + ((x4 + x5) + (x6 + x7));
  float4 half_sum = sum.lo + sum.hi;
  results[i] = (uint)(half_sum.x + half_sum.y + half_sum.z + half_sum.w);
}
