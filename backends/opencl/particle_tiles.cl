// Runs one work item per tile, which draws the tile's entries (the particles that overlap the tile)
// into the tile's pixels. The nearest surface is visible. If depths are equal, the particle that
// comes first in technique::Arrangement wins.

// The number of pixels that are tested together. Pixels outside of a row's range are masked. Every
// row is stored with a margin at its end, for the pixels beyond the tile.
#define TRI_LANES 8
#define TRI_STRIDE (TRI_TILE + TRI_LANES)
// The number of entries after which the farthest depth of the tile is recomputed.
#define TRI_LOOK_EVERY 8

typedef struct {
  float depth[TRI_TILE * TRI_STRIDE];  // reversed depth; 0 if nothing was drawn
  uint winner[TRI_TILE * TRI_STRIDE];
#if TRI_RAY_AT_VERTEX
  float cosine[TRI_TILE * TRI_STRIDE];  // for shading: the cosine between the ray and the surface normal
#endif
  float column[TRI_STRIDE];            // for rays: sx of each column of pixels
  float row[TRI_TILE];                 // and sy of each row of pixels
  int x, y;                            // the tile's first pixel
  // the tile's last pixel within the image, relative to the first
  int last_x, last_y;
  float farthest;  // no visible surface in the tile is farther away than this along the view axis
  int drawn;       // number of entries drawn since `farthest` was computed
} Tile;

#if TRI_REVERSED_DEPTH
#define TRI_CLEAR_DEPTH 2.0f
#define TRI_BEFORE(a, b) ((a) < (b))
#else
#define TRI_CLEAR_DEPTH 0.0f
#define TRI_BEFORE(a, b) ((a) > (b))
#endif
#if TRI_UNRESOLVED_TIES
#define TRI_FIRST_OF_EQUALS(a, b) ((b) == TRI_NONE || (a) > (b))
#else
#define TRI_FIRST_OF_EQUALS(a, b) ((a) < (b))
#endif

TRI_FN void open_tile(const Particles* u, int x, int y, Tile* tile) {
  tile->x = x;
  tile->y = y;
  tile->last_x = min(TRI_TILE, u->viewport.x - x) - 1;
  tile->last_y = min(TRI_TILE, u->viewport.y - y) - 1;
  tile->farthest = INFINITY;
  tile->drawn = 0;
  for (int k = 0; k < TRI_STRIDE; ++k) tile->column[k] = pixel_ray_x(u, x + k);
  for (int k = 0; k < TRI_TILE; ++k) tile->row[k] = pixel_ray_y(u, y + k);
  for (int k = 0; k < TRI_TILE * TRI_STRIDE; ++k) tile->depth[k] = TRI_CLEAR_DEPTH;
  for (int k = 0; k < TRI_TILE * TRI_STRIDE; ++k) tile->winner[k] = TRI_NONE;
}

// Returns the smallest reversed depth of the tile's pixels.
TRI_FN float lowest_depth(const Tile* tile) {
  float lowest[TRI_LANES];
  for (int k = 0; k < TRI_LANES; ++k) lowest[k] = 1.0f;
  for (int y = 0; y <= tile->last_y; ++y) {
    for (int x = 0; x <= tile->last_x; x += TRI_LANES) {
      for (int k = 0; k < TRI_LANES; ++k) {
        float depth = tile->depth[y * TRI_STRIDE + x + k];
        bool counts = x + k <= tile->last_x;
        lowest[k] = counts && depth < lowest[k] ? depth : lowest[k];
      }
    }
  }
  for (int k = 1; k < TRI_LANES; ++k) lowest[0] = lowest[k] < lowest[0] ? lowest[k] : lowest[0];
  return lowest[0];
}

TRI_FN void look_for_farthest(float near, Tile* tile) {
  tile->farthest = near / lowest_depth(tile);
  tile->drawn = 0;
}

// Returns whether no part of the sphere can be visible in the tile, because the front of the sphere
// is farther away than every surface that is stored. c contains the centre and the radius r. Both
// distances have a rounding error of up to 24·2⁻²⁴ of |c| + r, which is at most `size`, so they
// must differ by more than the sum of the two errors.
TRI_FN bool hidden(const Tile* tile, float4 c) {
#if TRI_REVERSED_DEPTH || !TRI_CONSERVATIVE_DEPTH
  return false;
#elif TRI_WRONG_SENSE
  return c.z + c.w > tile->farthest;
#else
  float size = fabs(c.x) + fabs(c.y) + fabs(c.z) + c.w;
  return c.z - c.w - 3e-6f * size > tile->farthest;
#endif
}

// Loads the rays of TRI_LANES pixels of row y (relative to the tile's first row). Sprites that
// interpolate rays supply their own.
TRI_FN void load_rays(const Tile* tile, const Polygon* polygon, int x, int y, float* sx,
                      float* sy) {
#if TRI_RAY_AT_VERTEX
  float from_x = (float)((tile->x + x) * TRI_SUBPIXELS + TRI_SUBPIXELS / 2);
  float down = (float)((tile->y + y) * TRI_SUBPIXELS + TRI_SUBPIXELS / 2);
  for (int k = 0; k < TRI_LANES; ++k) {
    float right = from_x + (float)(k * TRI_SUBPIXELS);
    const RayPlane* rays = &polygon->rays[fan_triangle(polygon, right, down)];
    sx[k] = rays->origin.x + right * rays->right.x + down * rays->down.x;
    sy[k] = rays->origin.y + right * rays->right.y + down * rays->down.y;
  }
#else
  for (int k = 0; k < TRI_LANES; ++k) sx[k] = tile->column[x + k];
  for (int k = 0; k < TRI_LANES; ++k) sy[k] = tile->row[y];
#endif
}

// Tests pixels x0…x1 of row y (relative to the tile's first pixel) with a sphere in camera space.
TRI_FN void draw_row(float near, int x0, int x1, int y, float4 c, uint particle,
                     const Polygon* polygon, Tile* tile, uint* kept) {
  for (int x = x0; x <= x1; x += TRI_LANES) {
    int at = y * TRI_STRIDE + x;
    // Local copies, so that the compiler can see that the arrays do not overlap.
    float sx[TRI_LANES];
    float sy[TRI_LANES];
    float depths[TRI_LANES];
    uint winners[TRI_LANES];
    load_rays(tile, polygon, x, y, sx, sy);
    for (int k = 0; k < TRI_LANES; ++k) depths[k] = tile->depth[at + k];
    for (int k = 0; k < TRI_LANES; ++k) winners[k] = tile->winner[at + k];
    int last = x1 - x;
    for (int k = 0; k < TRI_LANES; ++k) {
      float discriminant = tri_sphere_discriminant(c.x, c.y, c.z, c.w, sx[k], sy[k]);
      float distance = tri_sphere_distance(c.x, c.y, c.z, sx[k], sy[k], discriminant);
      float depth = tri_depth(near, distance);
      int hit = (discriminant >= 0.0f) & (distance > 0.0f) & (k <= last);
      int wins = hit & (TRI_BEFORE(depth, depths[k]) |
                        ((depth == depths[k]) & TRI_FIRST_OF_EQUALS(particle, winners[k])));
      depths[k] = wins ? depth : depths[k];
      winners[k] = wins ? particle : winners[k];
#if TRI_RAY_AT_VERTEX
      float cosine = tri_sphere_cosine(c.w, sx[k], sy[k], discriminant);
      tile->cosine[at + k] = wins ? cosine : tile->cosine[at + k];
#endif
#if TRI_COUNT
      *kept += (uint)hit;
#endif
    }
    for (int k = 0; k < TRI_LANES; ++k) tile->depth[at + k] = depths[k];
    for (int k = 0; k < TRI_LANES; ++k) tile->winner[at + k] = winners[k];
  }
}

TRI_FN void draw_entry(const Particles* u, __global const float* restrict camera,
                       __global const uint* restrict rectangles,
                       __global const float* restrict stored, uint particle, Tile* tile,
                       uint* fragments, uint* kept) {
  float4 c = vload4(particle, camera);
  if (hidden(tile, c)) return;
  uint first = rectangles[2 * (size_t)particle];
  uint last = rectangles[2 * (size_t)particle + 1];
  int x0 = max(unpacked_x(first) - tile->x, 0);
  int x1 = min(unpacked_x(last) - tile->x, tile->last_x);
  int y0 = max(unpacked_y(first) - tile->y, 0);
  int y1 = min(unpacked_y(last) - tile->y, tile->last_y);
  if (x0 > x1 || y0 > y1) return;
  Polygon polygon;
#if TRI_STORED
  stored_polygon(u, stored, particle, &polygon);
#elif TRI_SPRITE != 0
  make_polygon(u, c, &polygon);
#endif
  for (int y = y0; y <= y1; ++y) {
    int from = x0;
    int to = x1;
#if TRI_SPRITE != 0
    int2 row = covered_row(&polygon, tile->y + y);
    from = max(x0, row.x - tile->x);
    to = min(x1, row.y - 1 - tile->x);
#endif
    draw_row(u->eye.w, from, to, y, c, particle, &polygon, tile, kept);
#if TRI_COUNT
    *fragments += (uint)max(to - from + 1, 0);
#endif
  }
  if (++tile->drawn >= TRI_LOOK_EVERY) look_for_farthest(u->eye.w, tile);
}

// Loads the tile's pixels as an earlier pass of the frame has stored them.
TRI_FN void load_tile(const Particles* u, __global const float* restrict depths,
                      __global const uint* restrict winners,
                      __global const float* restrict cosines, Tile* tile) {
  for (int y = 0; y <= tile->last_y; ++y) {
    size_t from = (size_t)(tile->y + y) * (size_t)u->viewport.x + (size_t)tile->x;
    for (int x = 0; x <= tile->last_x; ++x) {
      int to = y * TRI_STRIDE + x;
      uint winner = winners[from + x];
      tile->winner[to] = winner;
      tile->depth[to] = winner == TRI_NONE ? TRI_CLEAR_DEPTH : depths[from + x];
#if TRI_RAY_AT_VERTEX
      tile->cosine[to] = cosines[from + x];
#endif
    }
  }
  look_for_farthest(u->eye.w, tile);
}

TRI_FN void store_tile(const Particles* u, const Tile* tile, __global float* restrict depths,
                       __global uint* restrict winners, __global float* restrict cosines) {
  for (int y = 0; y <= tile->last_y; ++y) {
    size_t to = (size_t)(tile->y + y) * (size_t)u->viewport.x + (size_t)tile->x;
    for (int x = 0; x <= tile->last_x; ++x) {
      int from = y * TRI_STRIDE + x;
      depths[to + x] = tile->winner[from] == TRI_NONE ? 0.0f : tile->depth[from];
      winners[to + x] = tile->winner[from];
#if TRI_RAY_AT_VERTEX
      cosines[to + x] = tile->cosine[from];
#endif
    }
  }
}

// `later` is 1 in a pass that adds to the result of an earlier pass. Writes the smallest reversed
// depth of each tile to farthest[tile].
__kernel void draw_tiles(__global const Particles* restrict parameters,
                         __global const float* restrict camera,
                         __global const uint* restrict rectangles,
                         __global const uint* restrict begins,
                         __global const uint* restrict entries, uint later,
                         __global float* restrict farthest, __global float* restrict depths,
                         __global uint* restrict winners, __global float* restrict cosines,
                         __global uint* restrict counters
#if TRI_STORED
                         , __global const float* restrict stored
#endif
) {
#if !TRI_STORED
  __global const float* stored = 0;
#endif
  int tile_x = (int)get_global_id(0);
  int tile_y = (int)get_global_id(1);
  Particles u = *parameters;
  int across = tiles_across(&u);
  int down = tiles_down(&u);
  uint number = (uint)(tile_y * across + tile_x);
  uint coarse = (uint)(across * down + (tile_y >> 3) * ((across + 7) >> 3) + (tile_x >> 3));
  uint drawn_in[2] = {coarse, number};
  if (later && begins[coarse] == begins[coarse + 1] && begins[number] == begins[number + 1]) return;
  Tile tile;
  open_tile(&u, tile_x << TRI_TILE_SHIFT, tile_y << TRI_TILE_SHIFT, &tile);
  if (later) load_tile(&u, depths, winners, cosines, &tile);
  uint fragments = 0;
  uint kept = 0;
  for (int k = 0; k < 2; ++k) {
    uint end = begins[drawn_in[k] + 1];
    for (uint at = begins[drawn_in[k]]; at < end; ++at) {
      draw_entry(&u, camera, rectangles, stored, entries[at], &tile, &fragments, &kept);
    }
  }
  store_tile(&u, &tile, depths, winners, cosines);
  farthest[number] = lowest_depth(&tile);
#if TRI_COUNT
  counters[8 * number + TRI_COUNT_FRAGMENTS] += fragments;
  counters[8 * number + TRI_COUNT_DISCARDED] += fragments - kept;
#endif
}
