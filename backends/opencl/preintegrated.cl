// The quadrature `preintegrated`: one step along which the value changes linearly from front to
// back (portable/volume_preintegration.h, technique::preintegrated_pairs). The algorithm is the
// same as in src/technique/volume/raycast/preintegrated.glsl.
#if TRI_PRECISION == 32

// Composites a piece of the step behind `gathered`, which is premultiplied colour and opacity.
// `depth` is the optical depth of the piece, whose opacity is 1 − 2^−depth. a0 … a2 are the
// coefficients of its colour as a quadratic function of the fraction of that depth.
TRI_FN float4 with_piece(float4 gathered, float depth, float3 a0, float3 a1, float3 a2) {
  float opacity = tri_1m_exp2(-depth);
  float z = 0.3465735903f * depth;
  float w = tri_attenuation(z, opacity);
  float inverse = 1.0f / (3.0f + w);
  float3 colour = a0 - (z * inverse) * a1 + (w * inverse) * a2;
  colour.x = clamp(colour.x, 0.0f, 1.0f);
  colour.y = clamp(colour.y, 0.0f, 1.0f);
  colour.z = clamp(colour.z, 0.0f, 1.0f);
  float weight = depth > 0.0f ? (1.0f - gathered.w) * opacity : 0.0f;
  return depth > 0.0f ? gathered + weight * (float4)(colour, 1.0f) : gathered;
}

// Composites the piece between positions a and b in the table of the transfer function. Both are in
// the cell (the interval between two adjacent entries) that begins with entry `cell`. The function
// is constant before the first entry and after the last.
TRI_FN float4 with_part_of_cell(__constant float4* table, float4 gathered, int cell, float a, float b,
                                float length) {
  float4 lower = table[cell > 0 ? cell : 0];
  float4 rise = table[cell < 255 ? cell + 1 : 255] - lower;
  float4 first = lower + (a - (float)cell) * rise;
  float3 change = (b - a) * rise.xyz;
  float last_alpha = lower.w + (b - (float)cell) * rise.w;
  float mean = tri_mean_log2_1m(first.w, last_alpha);
  float tilt = tri_tilt(first.w, last_alpha, mean);
  float square = tilt * tilt;
  return with_piece(gathered, -length * mean, first.xyz + (0.5f + 0.16666667f * tilt) * change,
                    (0.5f - 0.1f * square) * change,
                    (tilt * (0.071428571f * square - 0.16666667f)) * change);
}

TRI_FN bool are_too_deep(__global const float4* pairs, int first, int last, float per_cell) {
  return abs(last - first) > 1 && per_cell * pairs[3 * (256 * first + last)].x > TRI_DEEPEST_CHUNK;
}

// Returns the entry at which the next chunk ends, if the optical depth of all remaining cells
// exceeds TRI_DEEPEST_CHUNK. A chunk consists of consecutive cells that are composited as one
// piece. Starts with the number of cells that would reach this depth if all cells were equally
// deep, and halves the number until the chunk is not too deep. A chunk contains at least one cell.
TRI_FN int end_of_chunk(__global const float4* pairs, int first, int last, float per_cell) {
  int direction = last > first ? 1 : -1;
  float share = TRI_DEEPEST_CHUNK / (per_cell * pairs[3 * (256 * first + last)].x);
  int taken = max(1, (int)(share * (float)abs(last - first)));
  while (are_too_deep(pairs, first, first + direction * taken, per_cell)) taken /= 2;
  return first + direction * taken;
}

// Returns the premultiplied colour and opacity of a step of `length` voxels.
TRI_FN float4 preintegrated(__constant float4* table, __global const float4* pairs, float front,
                            float back, float length) {
  // NaN counts as the lowest value, as in the midpoint rule.
  float from = front * 256.0f - 0.5f;
  float to = back * 256.0f - 0.5f;
  from = from > -0.75f ? (from < 255.75f ? from : 255.75f) : -0.75f;
  to = to > -0.75f ? (to < 255.75f ? to : 255.75f) : -0.75f;
  int first_cell = (int)tri_floor(from);
  int last_cell = (int)tri_floor(to);
  float4 gathered = (float4)(0.0f);
  if (first_cell == last_cell) {
    return with_part_of_cell(table, gathered, first_cell, from, to, length);
  }
  bool rising = last_cell > first_cell;
  // the first table entry that the step passes
  int first = rising ? first_cell + 1 : first_cell;
  int last = rising ? last_cell : last_cell + 1;
  float per_cell = length / fabs(to - from);
  gathered = with_part_of_cell(table, gathered, first_cell, from, (float)first,
                               per_cell * fabs((float)first - from));
#if TRI_PREINTEGRATED == 2
  while (1.0f - gathered.w > TRI_LEAST_LEFT && are_too_deep(pairs, first, last, per_cell)) {
    int there = end_of_chunk(pairs, first, last, per_cell);
    __global const float4* chunk = pairs + 3 * (256 * first + there);
    gathered = with_piece(gathered, per_cell * chunk[0].x, chunk[0].yzw, chunk[1].xyz, chunk[2].xyz);
    first = there;
  }
#endif
  __global const float4* pair = pairs + 3 * (256 * first + last);
  gathered = with_piece(gathered, per_cell * pair[0].x, pair[0].yzw, pair[1].xyz, pair[2].xyz);
  return with_part_of_cell(table, gathered, last_cell, (float)last, to,
                           per_cell * fabs(to - (float)last));
}

#endif
