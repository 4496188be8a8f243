// Each invocation computes the box of one node in a level from the boxes of its two children. TRI_STEP.x is the
// index of the level's first node, which is also the number of nodes in the level.
layout(local_size_x = 64) in;

void main() {
  uint n = 64u * (gl_WorkGroupID.y * TRI_GROUP_COLUMNS + gl_WorkGroupID.x) + gl_LocalInvocationIndex;
  if (n >= TRI_STEP.x) return;
  uint node = TRI_STEP.x + n;
  boxes[2u * node] = min(boxes[4u * node], boxes[4u * node + 2u]);
  boxes[2u * node + 1u] = max(boxes[4u * node + 1u], boxes[4u * node + 3u]);
}
