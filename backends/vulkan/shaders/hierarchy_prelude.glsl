// The declarations that the passes of `bvh` need in addition to particle_prelude.glsl.
layout(push_constant) uniform Tree {
  vec4 origin;
  uvec4 shape;
  uvec4 step;
} tree;
#define TRI_TREE_ORIGIN tree.origin
#define TRI_TREE_SHAPE tree.shape
#define TRI_STEP tree.step
#include "portable/box_math.h"
#include "particles/hierarchy.glsl"
