#version 450
#extension GL_GOOGLE_include_directive : require
// Evaluates the functions of volume_math.h for one vector per invocation. maths_device_test.cpp does the
// same in C++.
#include "portable/prelude.glsl"
#include "portable/volume_math.h"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer In { vec2 vectors[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Out { float results[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= vectors.length()) return;
  vec2 v = vectors[i];
  vec2 slab = tri_slab(v.x * 16.0 - 4.0, v.y - 1.0, 9.0);
  uint at = 16 * i;
  results[at] = slab.x;
  results[at + 1] = slab.y;
  results[at + 2] = float(tri_sample_count(v.y * 256.0));
  results[at + 3] = tri_step_share(v.y * 4.0, 2);
  results[at + 4] = tri_table_position(v.x);
  results[at + 5] = tri_log2_1m(v.x);
  results[at + 6] = tri_1m_exp2(-8.0 * v.y);
  results[at + 7] = tri_opacity(v.x, v.y);
  for (int form = -2; form <= 4; ++form) results[at + 10 + form] = tri_opacity_by_form(v.x, v.y, form);
  results[at + 15] = 0.0;
}
