// Each invocation computes the position of one particle's centre on the Hilbert curve.
layout(local_size_x = 64) in;

void main() {
  uint i = 64u * (gl_WorkGroupID.y * TRI_GROUP_COLUMNS + gl_WorkGroupID.x) + gl_LocalInvocationIndex;
  if (i >= TRI_TREE_SHAPE.x) return;
  vec4 sphere = spheres[i];
  vec4 origin = TRI_TREE_ORIGIN;
  sorted[2u * i] = uint(tri_hilbert_place(tri_grid_cell(sphere.x, origin.x, origin.w),
                                          tri_grid_cell(sphere.y, origin.y, origin.w),
                                          tri_grid_cell(sphere.z, origin.z, origin.w)));
  sorted[2u * i + 1u] = i;
}
