// Each invocation processes one run of particles. For each value of the current digit (eight bits of the position on
// the curve), it counts the particles of the run with this value. TRI_STEP contains the lowest bit of the digit, the
// index in `sorted` at which the input list begins, and the number of runs.
layout(local_size_x = 64) in;

void main() {
  uint run = gl_GlobalInvocationID.x;
  uint runs = TRI_STEP.z;
  if (run >= runs) return;
  for (uint digit = 0u; digit < TRI_DIGITS; ++digit) scratch[digit * runs + run] = 0u;
  uint end = run_begin(TRI_TREE_SHAPE.x, runs, run + 1u);
  for (uint i = run_begin(TRI_TREE_SHAPE.x, runs, run); i < end; ++i) {
    uint digit = sorted[2u * (TRI_STEP.y + i)] >> TRI_STEP.x & (TRI_DIGITS - 1u);
    ++scratch[digit * runs + run];
  }
}
