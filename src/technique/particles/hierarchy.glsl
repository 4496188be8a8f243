// The hierarchy of `bvh`: a complete binary tree over the particles in the order of Hilbert's curve. Nodes are numbered
// as in a heap, from 1; the n particles are dealt out to 2^levels leaves, each with a run of n/2^levels of them or one
// more. So it needs no pointers, and its shape follows from n alone (technique::Hierarchy).
//   hierarchy_keys      each particle's place on the curve
//   hierarchy_count, _rows, _totals, _scatter   four times: a stable radix sort by eight bits of it
//   hierarchy_leaves    spheres in the order of the tree, and the boxes of its leaves
//   hierarchy_level     a level of boxes from the one below
// The backend gives TRI_TREE_ORIGIN (vec4: where the curve's grid begins, cells per unit), TRI_TREE_SHAPE (uvec4:
// particles, levels, particles of a leaf, leaves that have one more) and TRI_STEP (uvec4), which each pass explains.
layout(std430) TRI_BINDING(7) buffer Boxes { vec4 boxes[]; };              // lower and upper corner of each node
layout(std430) TRI_BINDING(8) buffer TreeSpheres { vec4 tree_spheres[]; };  // world space, in the order of the tree
layout(std430) TRI_BINDING(9) buffer TreeOrder { uint tree_order[]; };      // their particles
layout(std430) TRI_BINDING(10) buffer Sorted { uint sorted[]; };            // two lists of (place, particle)
layout(std430) TRI_BINDING(12) buffer Scratch { uint scratch[]; };

#define TRI_DIGITS 256u

// The index at which the k-th of `parts` runs of n things begins.
uint run_begin(uint n, uint parts, uint k) { return n / parts * k + min(k, n % parts); }
uint leaf_begin(uint leaf) { return TRI_TREE_SHAPE.z * leaf + min(leaf, TRI_TREE_SHAPE.w); }
// Groups of 64 invocations are dispatched in rows of this many.
#define TRI_GROUP_COLUMNS 65535u
