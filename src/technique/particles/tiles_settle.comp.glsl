// After the round has drawn into the tiles, one invocation per tile prepares the tile for the next round.
layout(local_size_x = 64) in;

void main() {
  uint index = gl_GlobalInvocationID.x;
  ivec2 grid = tile_grid();
  if (index >= uint(grid.x * grid.y)) return;
  uint count = tiles[index].entries;
  uint flags = tiles[index].flags;
  if (count == 0u && (flags & TRI_TOUCHED) == 0u) return;
  tiles[index].farthest = tiles[index].coming;
  tiles[index].flags = flags & ~TRI_TOUCHED | (count > 0u ? TRI_HAS_LARGE : 0u);
  tiles[index].entries = 0u;
}
