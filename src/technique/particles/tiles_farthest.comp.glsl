// What tiles_resolve does for a round without large spheres: one invocation per tile finds the farthest of
// what its pixels show.
layout(local_size_x = 64) in;

void main() {
  uint index = gl_GlobalInvocationID.x;
  ivec2 grid = tile_grid();
  if (index >= uint(grid.x * grid.y)) return;
  ivec2 first = TRI_TILE * ivec2(int(index) % grid.x, int(index) / grid.x);
  ivec2 extent = min(ivec2(TRI_TILE), u.viewport.xy - first);
  uint farthest = TRI_LARGEST_KEY;
  // A tile with an empty pixel is done: most are, as long as there is little in the picture.
  for (int i = 0; i < extent.x * extent.y && farthest > 0u; ++i) {
    farthest = min(farthest, pixels[pixel_index(first + ivec2(i % extent.x, i / extent.x))]);
  }
  tiles[index].farthest = farthest;
}
