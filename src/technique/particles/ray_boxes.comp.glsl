// Each invocation writes the padded box of one particle as six floats, in the format required by
// Vulkan.
layout(local_size_x = 64) in;
layout(std430) TRI_BINDING(7) writeonly buffer SphereBoxes { float sphere_boxes[]; };

void main() {
  uint i = 64u * (gl_WorkGroupID.y * TRI_GROUP_COLUMNS + gl_WorkGroupID.x) + gl_LocalInvocationIndex;
  if (i >= u.counts.x) return;
  vec3 lo;
  vec3 hi;
  padded_box(spheres[i], lo, hi);
  for (int axis = 0; axis < 3; ++axis) {
    sphere_boxes[6u * i + uint(axis)] = lo[axis];
    sphere_boxes[6u * i + 3u + uint(axis)] = hi[axis];
  }
}
