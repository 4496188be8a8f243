// hierarchy_rows has stored the total number of particles for each value of the radix sort's current digit. A single
// invocation replaces each total by the position at which the particles with this value begin.
layout(local_size_x = 1) in;

void main() {
  uint at = TRI_DIGITS * TRI_STEP.z;
  uint sum = 0u;
  for (uint digit = 0u; digit < TRI_DIGITS; ++digit) {
    uint here = scratch[at + digit];
    scratch[at + digit] = sum;
    sum += here;
  }
}
