// One invocation per tile finds the farthest of what its pixels show, and empties its list for the next round.
// TRI_LARGE: whether large spheres have been drawn.
layout(local_size_x = 64) in;
#if TRI_LARGE
TRI_BINDING(20) uniform sampler2D large_depth;
#endif

uint depth_shown(ivec2 pixel) {
  uint key = depth_seen(pixel);
#if TRI_LARGE
  key = max(key, depth_key(texelFetch(large_depth, pixel, 0).x));
#endif
  return key;
}

void main() {
  int index = int(gl_GlobalInvocationID.x);
  ivec2 grid = tile_grid();
  if (index >= grid.x * grid.y) return;
  ivec2 first = TRI_TILE * ivec2(index % grid.x, index / grid.x);
  ivec2 extent = min(ivec2(TRI_TILE), u.viewport.xy - first);
  uint farthest = TRI_LARGEST_KEY;
  // A tile with an empty pixel is done: most are, as long as there is little in the picture.
  for (int i = 0; i < extent.x * extent.y && farthest > 0u; ++i) {
    farthest = min(farthest, depth_shown(first + ivec2(i % extent.x, i / extent.x)));
  }
  tiles[index].farthest = farthest;
  tiles[index].entries = 0u;
}
