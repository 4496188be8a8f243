// The hierarchy of `bvh`: a complete binary tree over the particles in the order of Hilbert's curve. Nodes are
// numbered from 1, as in a heap. The n particles are distributed among 2^levels leaves; each leaf has a run of
// n/2^levels particles (rounded down) or one more. Therefore the tree needs no pointers, and its shape depends only
// on n (technique::Hierarchy). These kernels build it:
//   hierarchy_keys      computes the position of each particle on the curve
//   hierarchy_count, _rows, _totals, _scatter   are one pass of a stable radix sort by eight bits of the position;
//                       there are four passes
//   hierarchy_leaves    writes the spheres in the order of the tree, and the boxes of its leaves
//   hierarchy_level     computes a level of boxes from the level below
// The backend defines TRI_TREE_ORIGIN (vec4: the corner of the curve's grid, and its cells per unit), TRI_TREE_SHAPE
// (uvec4: the number of particles, of levels, of particles in a leaf, and of leaves with one more particle) and
// TRI_STEP (uvec4), which each kernel explains.
layout(std430) TRI_BINDING(7) buffer Boxes { vec4 boxes[]; };              // lower and upper corner of each node
layout(std430) TRI_BINDING(8) buffer TreeSpheres { vec4 tree_spheres[]; };  // world space, in the order of the tree
layout(std430) TRI_BINDING(9) buffer TreeOrder { uint tree_order[]; };      // the particle of each tree sphere
layout(std430) TRI_BINDING(10) buffer Sorted { uint sorted[]; };            // two lists of (position, particle)
layout(std430) TRI_BINDING(12) buffer Scratch { uint scratch[]; };

#define TRI_DIGITS 256u

// The index at which run k begins if n items are divided into `parts` runs.
uint run_begin(uint n, uint parts, uint k) { return n / parts * k + min(k, n % parts); }
uint leaf_begin(uint leaf) { return TRI_TREE_SHAPE.z * leaf + min(leaf, TRI_TREE_SHAPE.w); }
// Work groups of 64 invocations are dispatched in rows of this many groups.
#define TRI_GROUP_COLUMNS 65535u
