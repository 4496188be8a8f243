// Each invocation processes one of the 256 values of the radix sort's current digit. hierarchy_count has counted the
// particles with this value in each run of particles. The invocation replaces these counts by their prefix sums, which
// are the positions of the runs among all particles with this value, and stores the total. TRI_STEP is the same as for
// hierarchy_count.
layout(local_size_x = 64) in;

void main() {
  uint digit = gl_GlobalInvocationID.x;
  uint runs = TRI_STEP.z;
  if (digit >= TRI_DIGITS) return;
  uint sum = 0u;
  for (uint run = 0u; run < runs; ++run) {
    uint here = scratch[digit * runs + run];
    scratch[digit * runs + run] = sum;
    sum += here;
  }
  scratch[TRI_DIGITS * runs + digit] = sum;
}
