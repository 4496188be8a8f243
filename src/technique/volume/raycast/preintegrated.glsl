// quadrature=preintegrated, in which the value is linear along each step, from front to back
// (portable/volume_preintegration.h, technique::preintegrated_pairs). A cell is the interval between two adjacent
// entries of the transfer function.
//
// The state of a step that is processed in several parts, because its whole cells are too deep for one look-up.
struct Cut {
  float per_cell;  // voxels per cell; 0 if no part of the step has been processed
  float left;      // share of the light at the front of the step that remains
};

#if TRI_PRECISION == 32

// Composites a piece of the step behind `gathered`, which contains premultiplied colour and opacity. `depth` is the
// piece's optical depth in powers of two, so the piece transmits 2^−depth of the light. a0, a1 and a2 are the Legendre
// coefficients of its colour as a function of the share of this depth that the light has passed.
void add_piece(inout vec4 gathered, float depth, vec3 a0, vec3 a1, vec3 a2) {
  float opacity = tri_1m_exp2(-depth);
  float z = 0.3465735903 * depth;
  float w = tri_attenuation(z, opacity);
  float inverse = 1.0 / (3.0 + w);
  vec3 colour = clamp(a0 - (z * inverse) * a1 + (w * inverse) * a2, 0.0, 1.0);
  if (depth > 0.0) {
    float weight = (1.0 - gathered.a) * opacity;
    gathered += weight * vec4(colour, 1.0);
  }
}

// Adds the piece between the positions a and b, in units of entries, within the cell that begins with entry `cell`.
// The transfer function is constant before the first entry and after the last.
void add_part_of_cell(inout vec4 gathered, int cell, float a, float b, float length) {
  vec4 lower = transfer_entry(max(cell, 0));
  vec4 rise = transfer_entry(min(cell + 1, 255)) - lower;
  vec4 first = lower + (a - float(cell)) * rise;
  vec4 change = (b - a) * rise;
  float last_alpha = lower.a + (b - float(cell)) * rise.a;
  float mean = tri_mean_log2_1m(first.a, last_alpha);
  float tilt = tri_tilt(first.a, last_alpha, mean);
  float square = tilt * tilt;
  add_piece(gathered, -length * mean, first.rgb + (0.5 + 0.16666667 * tilt) * change.rgb,
            (0.5 - 0.1 * square) * change.rgb, (tilt * (0.071428571 * square - 0.16666667)) * change.rgb);
}

// Returns the optical depth of the whole cells (intervals between entries) from entry `first` to `last`, in powers of
// two.
float depth_of_cells(int first, int last, float per_cell) {
  return per_cell * quadrature_entry(3 * (256 * first + last)).x;
}

void add_cells(inout vec4 gathered, int first, int last, float per_cell) {
  int pair = 3 * (256 * first + last);
  vec4 depth_and_mean = quadrature_entry(pair);
  add_piece(gathered, per_cell * depth_and_mean.x, depth_and_mean.yzw, quadrature_entry(pair + 1).xyz,
            quadrature_entry(pair + 2).xyz);
}

bool are_too_deep(int first, int last, float per_cell) {
  return abs(last - first) > 1 && depth_of_cells(first, last, per_cell) > TRI_DEEPEST_CHUNK;
}

// Returns the last entry of the next chunk, for cells that are too deep to be processed at once. The search starts
// with the number of cells that would not be too deep if all cells were equally deep, and halves this number until
// the chunk is not too deep. The chunk has at least one cell.
int end_of_chunk(int first, int last, float per_cell) {
  int direction = last > first ? 1 : -1;
  float share = TRI_DEEPEST_CHUNK / depth_of_cells(first, last, per_cell);
  int taken = max(1, int(share * float(abs(last - first))));
#if TRI_LONG_RAYS
  for (int i = 0; i < 8; ++i) {  // constant length, so it is unrolled and adds no loop iterations
    if (are_too_deep(first, first + direction * taken, per_cell)) taken /= 2;
  }
#else
  while (are_too_deep(first, first + direction * taken, per_cell)) taken /= 2;
#endif
  return first + direction * taken;
}

// Returns the premultiplied colour and opacity of a step of `length` voxels from value `front` to `back`. If
// TRI_PREINTEGRATED is 2, it processes only the next part of the step. Afterwards, the step is complete if
// cut.per_cell is 0; otherwise, it continues from the new `front`. Each part is an iteration of the loop over steps
// instead of a loop in this function, because the number of iterations is limited (see raycast()).
vec4 preintegrated(inout float front, float back, float length, inout Cut cut) {
  // NaN is treated as the lowest value, as in the midpoint rule.
  float from = front * 256.0 - 0.5;
  float to = back * 256.0 - 0.5;
  from = from > -0.75 ? min(from, 255.75) : -0.75;
  to = to > -0.75 ? min(to, 255.75) : -0.75;
  bool begun = TRI_PREINTEGRATED == 2 && cut.per_cell > 0.0;  // whether the step continues at an entry
  int first_cell = int(floor(from));
  int last_cell = int(floor(to));
  bool one_cell = first_cell == last_cell;
  bool rising = last_cell > first_cell;
  int first = rising && !begun ? first_cell + 1 : first_cell;  // the first entry that the step passes
  int last = rising ? last_cell : last_cell + 1;
  float per_cell = begun ? cut.per_cell : length / max(abs(to - from), 1.0e-30);
  vec4 gathered = vec4(0.0);
  if (begun) length = per_cell * abs(to - from);
  add_part_of_cell(gathered, first_cell, from, one_cell ? to : float(first),
                   one_cell ? length : per_cell * abs(float(first) - from));
  cut.per_cell = 0.0;
  front = back;
  if (!one_cell) {
    int there = last;
    if (TRI_PREINTEGRATED == 2 && cut.left > TRI_LEAST_LEFT && are_too_deep(first, last, per_cell)) {
      there = end_of_chunk(first, last, per_cell);
    }
    add_cells(gathered, first, there, per_cell);
    bool whole = TRI_PREINTEGRATED != 2 || there == last;
    add_part_of_cell(gathered, last_cell, float(last), whole ? to : float(last),
                     whole ? per_cell * abs(to - float(last)) : 0.0);
    if (!whole) {
      cut.per_cell = per_cell;
      front = (float(there) + 0.5) / 256.0;
    }
  }
  cut.left = cut.per_cell > 0.0 ? cut.left * (1.0 - gathered.a) : 1.0;
  return gathered;
}

#endif
