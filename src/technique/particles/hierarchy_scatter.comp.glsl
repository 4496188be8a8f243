// Each invocation copies one run of particles to their positions in the output list of the radix sort. TRI_STEP is the
// same as for hierarchy_count.
layout(local_size_x = 64) in;

void main() {
  uint run = gl_GlobalInvocationID.x;
  uint runs = TRI_STEP.z;
  if (run >= runs) return;
  uint from = TRI_STEP.y;
  uint to = TRI_TREE_SHAPE.x - from;
  uint end = run_begin(TRI_TREE_SHAPE.x, runs, run + 1u);
  for (uint i = run_begin(TRI_TREE_SHAPE.x, runs, run); i < end; ++i) {
    uint key = sorted[2u * (from + i)];
    uint digit = key >> TRI_STEP.x & (TRI_DIGITS - 1u);
    uint at = to + scratch[TRI_DIGITS * runs + digit] + scratch[digit * runs + run]++;
    sorted[2u * at] = key;
    sorted[2u * at + 1u] = sorted[2u * (from + i) + 1u];
  }
}
