// One invocation per tile: a place for its entries. Their order among tiles means nothing.
layout(local_size_x = 64) in;

void main() {
  int index = int(gl_GlobalInvocationID.x);
  ivec2 grid = tile_grid();
  if (index >= grid.x * grid.y) return;
  uint count = tiles[index].entries;
  if (count > 0u) {
    tiles[index].next = atomicAdd(placed_entries, count);
    tiles[index].used = 1u;
  }
}
