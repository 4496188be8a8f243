// Builds the hierarchy of technique/particles/hierarchy.glsl with the same passes, which produce
// the same tree. `shape` contains the number of particles, the number of levels, the smallest
// number of particles in a leaf, and the number of leaves that contain one more particle than this.
#define TRI_DIGITS 256u

// Returns the index at which the k-th of `parts` runs of n elements begins.
TRI_FN uint run_begin(uint n, uint parts, uint k) { return n / parts * k + min(k, n % parts); }
TRI_FN uint leaf_begin(uint4 shape, uint leaf) { return shape.z * leaf + min(leaf, shape.w); }

// Returns the box around a sphere. The injected fault halves the radius.
TRI_FN float8 sphere_box(float4 s) {
  float r = TRI_SMALL_BOX ? 0.5f * s.w : s.w;
  return (float8)(tri_box_low(s.x, r), tri_box_low(s.y, r), tri_box_low(s.z, r), 0.0f,
                  tri_box_high(s.x, r), tri_box_high(s.y, r), tri_box_high(s.z, r), 0.0f);
}
TRI_FN float8 union_of(float8 a, float8 b) {
  return (float8)(a.lo < b.lo ? a.lo : b.lo, a.hi > b.hi ? a.hi : b.hi);
}

// Runs one work item per particle. origin.xyz is the origin of the grid of the Hilbert curve, and
// origin.w is the number of grid cells per unit of length.
__kernel void find_places(float4 origin, uint4 shape, __global const float* restrict spheres,
                          __global uint2* restrict sorted) {
  uint i = (uint)get_global_id(0);
  if (i >= shape.x) return;
  float4 s = vload4(i, spheres);
  int place = tri_hilbert_place(tri_grid_cell(s.x, origin.x, origin.w), tri_grid_cell(s.y, origin.y, origin.w),
                                tri_grid_cell(s.z, origin.z, origin.w));
  sorted[i] = (uint2)((uint)place, i);
}

// One pass of a radix sort consists of this kernel and the next two kernels. `sorted` contains two
// lists; a pass moves the particles from the list that begins at index `from` to the other list.
// This kernel runs one work item per run of particles, which counts the particles with each digit.
// A digit consists of the eight bits of a particle's position on the curve that begin at bit
// `shift`.
__kernel void count_digits(uint4 shape, uint shift, uint from, __global const uint2* restrict sorted,
                           __global uint* restrict scratch) {
  uint run = (uint)get_global_id(0);
  uint runs = (uint)get_global_size(0);
  uint counts[TRI_DIGITS];
  for (uint digit = 0; digit < TRI_DIGITS; ++digit) counts[digit] = 0;
  uint end = run_begin(shape.x, runs, run + 1);
  for (uint i = run_begin(shape.x, runs, run); i < end; ++i) {
    ++counts[sorted[from + i].x >> shift & (TRI_DIGITS - 1)];
  }
  for (uint digit = 0; digit < TRI_DIGITS; ++digit) scratch[digit * runs + run] = counts[digit];
}

// Runs a single work item. For each run and each digit, it computes the position to which the run's
// first particle with this digit is moved.
__kernel void place_digits(uint runs, __global uint* restrict scratch) {
  uint sum = 0;
  for (uint at = 0; at < TRI_DIGITS * runs; ++at) {
    uint here = scratch[at];
    scratch[at] = sum;
    sum += here;
  }
}

// Runs one work item per run, which moves the particles of the run to their places in the other of
// the two lists.
__kernel void move_to_places(uint4 shape, uint shift, uint from, __global uint2* restrict sorted,
                             __global const uint* restrict scratch) {
  uint run = (uint)get_global_id(0);
  uint runs = (uint)get_global_size(0);
  uint places[TRI_DIGITS];
  for (uint digit = 0; digit < TRI_DIGITS; ++digit) places[digit] = scratch[digit * runs + run];
  uint to = shape.x - from;
  uint end = run_begin(shape.x, runs, run + 1);
  for (uint i = run_begin(shape.x, runs, run); i < end; ++i) {
    uint2 entry = sorted[from + i];
    sorted[to + places[entry.x >> shift & (TRI_DIGITS - 1)]++] = entry;
  }
}

// Runs one work item per leaf. `moved` is 1 if the order already exists and only the spheres have
// moved.
__kernel void fit_leaves(uint4 shape, uint moved, __global const float* restrict spheres,
                         __global const uint2* restrict sorted, __global float* restrict boxes,
                         __global float* restrict tree_spheres, __global uint* restrict tree_order) {
  uint leaf = (uint)get_global_id(0);
  uint leaves = 1u << shape.y;
  if (leaf >= leaves) return;
  float8 box = (float8)((float4)(3.4e38f), (float4)(-3.4e38f));
  uint end = leaf_begin(shape, leaf + 1);
  for (uint i = leaf_begin(shape, leaf); i < end; ++i) {
    uint particle = moved ? tree_order[i] : sorted[i].y;
    float4 sphere = vload4(particle, spheres);
    box = union_of(box, sphere_box(sphere));
    vstore4(sphere, i, tree_spheres);
    tree_order[i] = particle;
  }
  vstore8(box, leaves + leaf, boxes);
}

// Runs one work item per node of a level. The nodes of a level with n nodes have the numbers n to
// 2n − 1.
__kernel void fit_level(uint first, __global float* restrict boxes) {
  uint n = (uint)get_global_id(0);
  if (n >= first) return;
  uint node = first + n;
  vstore8(union_of(vload8(2 * node, boxes), vload8(2 * node + 1, boxes)), node, boxes);
}
