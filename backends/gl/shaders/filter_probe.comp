// Fetches the volume at given positions, as raycast does.
layout(local_size_x = TRI_GROUP_WIDTH, local_size_y = TRI_GROUP_HEIGHT) in;
layout(std430) TRI_BINDING(4) buffer Probe { vec4 probe[]; };  // xyz: position in voxels; w: the value found

void main() {
  int index = int(gl_GlobalInvocationID.y) * u.viewport.x + int(gl_GlobalInvocationID.x);
  probe[index].w = field(probe[index].xyz);
}
