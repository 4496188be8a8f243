// One invocation per tile: a place for its entries. Their order among tiles means nothing.
layout(local_size_x = 64) in;

void main() {
  uint index = gl_GlobalInvocationID.x;
  ivec2 grid = tile_grid();
  if (index >= uint(grid.x * grid.y)) return;
  uint count = tiles[index].entries;
  if (count > 0u) tiles[index].next = atomicAdd(placed_entries, count);
}
