#version 450
#extension GL_GOOGLE_include_directive : require
// Evaluates the functions of volume_math.h in double precision, and the operations that they use, for one
// vector per invocation. maths_device_test.cpp does the same in C++.
#define TRI_PRECISION 64
#include "portable/prelude.glsl"
#include "portable/volume_math.h"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer In { vec2 vectors[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Out { double results[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= vectors.length()) return;
  double x = double(vectors[i].x);
  double y = double(vectors[i].y);
  uint at = 16 * i;
  results[at] = double(TRI_HIGH_WORD(x));
  results[at + 1] = TRI_WITH_HIGH_WORD(x, 0x3fe00000);
  results[at + 2] = floor(0.5 - 8.0 * y);
  results[at + 3] = double(int(floor(0.5 - 8.0 * y)));
  results[at + 4] = tri_table_position(x);
  results[at + 5] = tri_log2_1m(x);
  results[at + 6] = tri_1m_exp2(-8.0 * y);
  results[at + 7] = tri_opacity(x, y);
  for (int form = -2; form <= 4; ++form) results[at + 10 + form] = tri_opacity_by_form(x, y, form);
  results[at + 15] = tri_step_share(4.0 * y, 2);
}
