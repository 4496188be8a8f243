// Adds each large sphere of the round to the tiles for which tiles_bin counted it.
layout(local_size_x = 64) in;

// Returns an entry, which represents a sphere in the list of a tile. The lower TRI_PARTICLE_BITS bits contain the
// particle's index. Above these bits, there is one bit for each quarter of the tile, which is 1 if the sphere may reach
// that quarter.
uint entry(uint particle, ivec4 rectangle, ivec2 tile) {
  ivec2 low = rectangle.xy - TRI_TILE * tile;
  ivec2 high = low + rectangle.zw - 1;
  uint columns = (low.x < TRI_TILE / 2 ? 1u : 0u) | (high.x >= TRI_TILE / 2 ? 2u : 0u);
  uint quarters = (low.y < TRI_TILE / 2 ? columns : 0u) | (high.y >= TRI_TILE / 2 ? columns << 2 : 0u);
  return particle | quarters << TRI_PARTICLE_BITS;
}

void main() {
  uint stride = 64u * gl_NumWorkGroups.x;
  for (uint n = gl_GlobalInvocationID.x; n < large_kept; n += stride) {
    uint particle = kept[large_place(n)];
    vec4 sphere = texelFetch(camera_texels, int(particle));
    ivec4 rectangle = pixel_rectangle(sphere);
    uint front = front_key(sphere);
    ivec2 first = rectangle.xy / TRI_TILE;
    ivec2 last = (rectangle.xy + rectangle.zw - 1) / TRI_TILE;
    int count = (last.x - first.x + 1) * (last.y - first.y + 1);
    ivec2 tile = first;
    for (int i = 0; i < count; ++i) {
      int index = tile_index(tile);
      if (front >= farthest_in(index)) {
        entries[atomicAdd(tiles[index].next, 1u)] = entry(particle, rectangle, tile);
      }
      ++tile.x;
      if (tile.x > last.x) tile = ivec2(first.x, tile.y + 1);
    }
  }
}
