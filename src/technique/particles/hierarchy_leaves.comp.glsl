// Each invocation copies the spheres of one leaf and computes the leaf's box. TRI_STEP.x is 1 for a refit, in
// which tree_order already exists and only the spheres have moved.
layout(local_size_x = 64) in;

void main() {
  uint leaf = 64u * (gl_WorkGroupID.y * TRI_GROUP_COLUMNS + gl_WorkGroupID.x) + gl_LocalInvocationIndex;
  uint leaves = 1u << TRI_TREE_SHAPE.y;
  if (leaf >= leaves) return;
  vec3 low = vec3(3.4e38);
  vec3 high = vec3(-3.4e38);
  uint end = leaf_begin(leaf + 1u);
  for (uint i = leaf_begin(leaf); i < end; ++i) {
    uint particle = TRI_STEP.x == 1u ? tree_order[i] : sorted[2u * i + 1u];
    vec4 sphere = spheres[particle];
    vec3 lo;
    vec3 hi;
    sphere_box(sphere, lo, hi);
    low = min(low, lo);
    high = max(high, hi);
    tree_spheres[i] = sphere;
    tree_order[i] = particle;
  }
  boxes[2u * (leaves + leaf)] = vec4(low, 0.0);
  boxes[2u * (leaves + leaf) + 1u] = vec4(high, 0.0);
}
