// Each work group processes the particles of one cell. It draws small spheres and counts the entries of large spheres,
// that is, the (tile, sphere) pairs.
layout(local_size_x = 64) in;
TRI_BINDING(17) uniform samplerBuffer sphere_texels;
layout(std430) TRI_BINDING(12) readonly buffer CellEnds { uint cell_ends[]; };

// Raises the depth keys of the pixels that the sphere covers; a larger key means a smaller distance. Returns whether
// the sphere is, or may be, visible at any of these pixels. A single loop visits all pixels of the rectangle, because
// with nested loops all lanes would wait for the longest row each time.
bool draw_small(vec4 sphere, ivec4 rectangle, int count) {
  bool seen = false;
  ivec2 pixel = rectangle.xy;
  int right = rectangle.x + rectangle.z;
  for (int i = 0; i < count; ++i) {
    uint key = sphere_key(sphere, pixel_ray(pixel));
    if (key > 0u && key >= depth_seen(pixel)) {  // depth_seen() may return an outdated depth
      atomicMax(pixels[pixel_index(pixel)], key);
      seen = true;
    }
    ++pixel.x;
    if (pixel.x == right) pixel = ivec2(rectangle.x, pixel.y + 1);
  }
  return seen;
}

// Counts an entry for each tile in which the sphere may be visible. Returns whether there is such a tile.
bool count_large(uint front, ivec4 rectangle, int count) {
  ivec2 first = rectangle.xy / TRI_TILE;
  int columns = (rectangle.x + rectangle.z - 1) / TRI_TILE - first.x + 1;
  bool entered = false;
  ivec2 tile = first;
  for (int i = 0; i < count; ++i) {
    int index = tile_index(tile);
    if (front >= farthest_in(index)) {
      atomicAdd(tiles[index].entries, 1u);
      entered = true;
#if TRI_COUNT
      add_count(TRI_COUNT_BIN_ENTRIES, uint(index), 1u);
#endif
    }
    ++tile.x;
    if (tile.x == first.x + columns) tile = ivec2(first.x, tile.y + 1);
  }
  return entered;
}

// Sets the flags of the tiles. Writes only if a flag is not set yet, because otherwise threads would contend for
// cache lines that other threads read.
void use_tiles(ivec4 rectangle) {
  ivec4 around = tiles_around(rectangle);
  for (int k = 0; k < 4; ++k) {
    const uint flags = TRI_USED | TRI_TOUCHED;
    if ((tile_state(around[k]).w & flags) != flags) atomicOr(tiles[around[k]].flags, flags);
  }
}

void bin(uint particle) {
  vec4 sphere = camera_space(texelFetch(sphere_texels, int(particle)));
  ivec4 rectangle = pixel_rectangle(sphere);
  uint front = front_key(sphere);
  bool covers = rectangle.z > 0;
  bool small = covers && is_small(rectangle);
  int pixel_count = small && front >= farthest_around(rectangle) ? rectangle.z * rectangle.w : 0;
  ivec2 tile_span = (rectangle.xy + rectangle.zw - 1) / TRI_TILE - rectangle.xy / TRI_TILE + 1;
  // The tiles are marked as used even if the sphere turns out to be hidden. Its visibility depends on what other
  // invocations have drawn so far, so the amount of work would otherwise vary from run to run.
  if (pixel_count > 0) use_tiles(rectangle);
  int tile_count = covers && !small ? tile_span.x * tile_span.y : 0;
  bool seen = draw_small(sphere, rectangle, pixel_count);
  bool entered = count_large(front, rectangle, tile_count);
  if (seen || entered) {
    uint place = seen ? atomicAdd(small_kept, 1u) : large_place(atomicAdd(large_kept, 1u));
    kept[place] = particle;
    camera_spheres[particle] = sphere;
  }
#if TRI_COUNT
  if (covers) add_count(TRI_COUNT_SPRITES, particle, 1u);
#endif
}

void main() {
  uint index = TRI_ROUND.x + gl_WorkGroupID.x;
  uint end = cell_ends[index];
  for (uint i = cells[index].begin + gl_LocalInvocationIndex; i < end; i += 64u) bin(i);
}
