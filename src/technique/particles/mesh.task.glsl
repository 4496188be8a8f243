// Include this after cull.glsl. Each work group processes 32 cells, with one invocation for each cell (a group of
// neighbouring particles, cells.glsl). It selects the cells to draw and computes the number of mesh work groups that
// each of these cells needs. TRI_CULLED (0 or 1): whether cells are culled. TRI_SHARE (uvec2): only every x-th cell is
// drawn, with only the first 1/y of its particles.
layout(local_size_x = 32) in;
taskPayloadSharedEXT CellList list;
shared uint drawn_count[32];
shared uint drawn_begin[32];

void main() {
  uint n = gl_LocalInvocationIndex;
  uint index = (32u * gl_WorkGroupID.x + n) * TRI_SHARE.x;
  drawn_count[n] = 0u;
  if (index < u.counts.y) {
    Cell cell = cells[index];
#if TRI_CULLED
    bool drawn = is_drawn(index, cell);
#else
    bool drawn = true;
#endif
    drawn_begin[n] = cell.begin;
    drawn_count[n] = drawn ? (cell.count + TRI_SHARE.y - 1u) / TRI_SHARE.y : 0u;
  }
  barrier();
  if (n == 0u) {
    uint groups = 0u;
    for (uint k = 0u; k < 32u; ++k) {
      list.begin[k] = drawn_begin[k];
      list.count[k] = drawn_count[k];
      groups += (drawn_count[k] + TRI_MESH_SPRITES - 1u) / TRI_MESH_SPRITES;
      list.end[k] = groups;
    }
    list.groups = groups;
  }
  barrier();
  EmitMeshTasksEXT(list.groups, 1, 1);
}
