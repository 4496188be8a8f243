// The hierarchy of the technique `bvh`: a complete binary tree over the particles in Hilbert-curve order. Nodes are
// numbered from 1, as in a binary heap. Each of the 2^levels leaves contains a run of ⌊n/2^levels⌋ of the n particles,
// or one more. The tree therefore needs no pointers, and its shape depends only on n (technique::Hierarchy). These
// kernels build it:
//   hierarchy_keys      computes the position of each particle on the curve
//   hierarchy_count, _rows, _totals, _scatter   perform one of the four passes of a stable radix sort; each pass
//                       sorts by eight bits of the position
//   hierarchy_leaves    writes the spheres in the order of the tree, and the boxes of its leaves
//   hierarchy_level     computes a level of boxes from the level below
// The backend defines TRI_TREE_ORIGIN (vec4: the lower corner of the curve's grid, and the number of grid cells per
// unit length), TRI_TREE_SHAPE (uvec4: the number n of particles, the number of levels, ⌊n/2^levels⌋, and the number
// of leaves with ⌊n/2^levels⌋ + 1 particles), and TRI_STEP (uvec4), whose components are explained in each kernel.
layout(std430) TRI_BINDING(7) buffer Boxes { vec4 boxes[]; };              // lower and upper corner of each node
layout(std430) TRI_BINDING(8) buffer TreeSpheres { vec4 tree_spheres[]; };  // in world space, in tree order
layout(std430) TRI_BINDING(9) buffer TreeOrder { uint tree_order[]; };      // the particle index of each tree sphere
layout(std430) TRI_BINDING(10) buffer Sorted { uint sorted[]; };            // two lists of (curve position, particle) pairs
layout(std430) TRI_BINDING(12) buffer Scratch { uint scratch[]; };

#define TRI_DIGITS 256u

// Returns the index at which run k begins if n items are divided into `parts` runs.
uint run_begin(uint n, uint parts, uint k) { return n / parts * k + min(k, n % parts); }
uint leaf_begin(uint leaf) { return TRI_TREE_SHAPE.z * leaf + min(leaf, TRI_TREE_SHAPE.w); }
// Work groups of 64 invocations are dispatched in rows of this many groups.
#define TRI_GROUP_COLUMNS 65535u
