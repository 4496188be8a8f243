// One invocation per tile decides whether this round draws into the tile. If so, it adds the tile to the list, whose
// order is arbitrary, and reserves space for the tile's entries (the large spheres that reach it).
layout(local_size_x = 64) in;

void list_tile(uint index) {
  uint n = atomicAdd(tiles_listed, 1u);
  tiles[n].listed = index;
  atomicMax(groups[0], min(n + 1u, TRI_MOST_GROUPS));
  atomicMax(groups[1], n / TRI_MOST_GROUPS + 1u);
  groups[2] = 1u;
}

void main() {
  uint index = gl_GlobalInvocationID.x;
  ivec2 grid = tile_grid();
  if (index >= uint(grid.x * grid.y)) return;
  uint count = tiles[index].entries;
  uint flags = tiles[index].flags;
  if (count == 0u && (flags & TRI_TOUCHED) == 0u) return;
  list_tile(index);
  tiles[index].next = atomicAdd(placed_entries, count);
  tiles[index].flags = flags | TRI_USED;
  tiles[index].coming = TRI_LARGEST_KEY;
}
