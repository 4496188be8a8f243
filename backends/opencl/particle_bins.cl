// Sorts the particles of the listed cells (ranges of neighbouring particles) into bins, and
// preserves their order (technique::Arrangement). A bin is a tile of the image or, for particles
// that overlap more than TRI_MOST_TILES tiles, a coarse tile of 8×8 tiles. The coarse bins follow
// the fine bins. Each particle in a bin is an entry of the bin. Each of `chunks` work items
// processes a range of the listed cells (a chunk) and has its own counts, so that no atomics are
// needed and the order is preserved.

// Counts the bins that one particle overlaps, or writes the particle into them.
TRI_FN void into_bins(uint first, uint last, int across, int down, bool fill, uint particle,
                      __global uint* restrict cursors, __global const uint* restrict begins,
                      __global uint* restrict entries) {
  int shift = TRI_TILE_SHIFT;
  int x0 = unpacked_x(first) >> shift, x1 = unpacked_x(last) >> shift;
  int y0 = unpacked_y(first) >> shift, y1 = unpacked_y(last) >> shift;
  int bins = 0;
  if ((x1 - x0 + 1) * (y1 - y0 + 1) > TRI_MOST_TILES) {
    bins = across * down;
    across = (across + 7) >> 3;
    x0 >>= 3;
    x1 >>= 3;
    y0 >>= 3;
    y1 >>= 3;
  }
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      int bin = bins + y * across + x;
#if TRI_LOST_AT_BORDER
      if (x == x1 && y == y1 && (x > x0 || y > y0)) continue;
#endif
      uint at = cursors[bin]++;
      if (fill) entries[begins[bin] + at] = particle;
    }
  }
}

// The number of particles that are transformed together. Compilers vectorise loops over arrays of
// this length.
#define TRI_BATCH 16

typedef struct {
  float x[TRI_BATCH];
  float y[TRI_BATCH];
  float z[TRI_BATCH];
  float r[TRI_BATCH];
  uint first[TRI_BATCH];  // rectangle of pixels
  uint last[TRI_BATCH];
  int corners[TRI_BATCH];  // corners of the sprite
} Batch;

// Loads n spheres in world space. If n is less than TRI_BATCH, the last sphere fills the rest of
// the batch.
TRI_FN void load_batch(__global const float* restrict spheres, uint n, Batch* batch) {
  for (uint k = 0; k < TRI_BATCH; ++k) {
    float4 sphere = vload4(min(k, n - 1), spheres);
    batch->x[k] = sphere.x;
    batch->y[k] = sphere.y;
    batch->z[k] = sphere.z;
    batch->r[k] = sphere.w;
  }
}

TRI_FN void to_camera_space(const Particles* u, Batch* batch) {
  for (int k = 0; k < TRI_BATCH; ++k) {
    float x = camera_x(u, batch->x[k], batch->y[k], batch->z[k]);
    float y = camera_y(u, batch->x[k], batch->y[k], batch->z[k]);
    float z = camera_z(u, batch->x[k], batch->y[k], batch->z[k]);
    batch->x[k] = x;
    batch->y[k] = y;
    batch->z[k] = z;
  }
}

#if TRI_SPRITE == 0
TRI_FN void find_rectangles(const Particles* u, Batch* batch) {
  for (int k = 0; k < TRI_BATCH; ++k) {
    float z = batch->z[k];
    float r = batch->r[k];
    float2 wide = covered(batch->x[k], z, r, u->plane.z, u->eye_rest.w);
    float2 high = covered(0.0f - batch->y[k], z, r, u->plane.w, u->eye_rest.w);
    int x0 = first_pixel(wide.x, u->plane.x, u->plane.z, u->viewport.x);
    int x1 = last_pixel(wide.y, u->plane.x, u->plane.z, u->viewport.x);
    int y0 = first_pixel(high.x, u->plane.y, u->plane.w, u->viewport.y);
    int y1 = last_pixel(high.y, u->plane.y, u->plane.w, u->viewport.y);
    bool empty = (x0 > x1) | (y0 > y1);
    batch->first[k] = empty ? TRI_EMPTY_FIRST : packed(x0, y0);
    batch->last[k] = empty ? TRI_EMPTY_LAST : packed(x1, y1);
    batch->corners[k] = 0;
  }
}
#elif TRI_STORED
// Computes the rectangles of n particles, beginning with particle `first`.
TRI_FN void find_rectangles(const Particles* u, __global const float* restrict stored, uint first,
                            uint n, Batch* batch) {
  for (uint k = 0; k < n; ++k) {
    Polygon polygon;
    batch->corners[k] = stored_polygon(u, stored, first + k, &polygon);
    polygon_rectangle(u, &polygon, &batch->first[k], &batch->last[k]);
  }
}
#else
TRI_FN void find_rectangles(const Particles* u, Batch* batch) {
  for (int k = 0; k < TRI_BATCH; ++k) {
    float4 sphere = (float4)(batch->x[k], batch->y[k], batch->z[k], batch->r[k]);
    Polygon polygon;
    batch->corners[k] = make_polygon(u, sphere, &polygon);
    polygon_rectangle(u, &polygon, &batch->first[k], &batch->last[k]);
  }
}
#endif

// Returns whether the particle is drawn: a sprite must have corners and, without sprites, the
// rectangle must not be empty.
TRI_FN bool is_sprite(uint first, uint last, int corners) {
  return TRI_SPRITE == 0 ? !is_empty(first, last) : corners > 0;
}

// Writes the listed cells' particles in camera space and their rectangles, and for each chunk the
// number of its entries in each bin.
__kernel void count_bins(__global const Particles* restrict parameters,
                         __global const float* restrict spheres,
                         __global const Cell* restrict cells, __global const uint* restrict list,
                         __global float* restrict camera, __global uint* restrict rectangles,
                         uint bins, __global uint* restrict counts,
                         __global uint* restrict counters
#if TRI_STORED
                         , __global const float* restrict stored
#endif
) {
  uint chunk = (uint)get_global_id(0);
  uint chunks = (uint)get_global_size(0);
  Particles u = *parameters;
  int across = tiles_across(&u);
  int down = tiles_down(&u);
  __global uint* cursors = counts + (size_t)bins * chunk;
  for (uint i = 0; i < bins; ++i) cursors[i] = 0;
  uint end = chunk_begin(list[0], chunk + 1, chunks);
  uint sprites = 0;
  uint vertices = 0;
  Batch batch;
  for (uint at = chunk_begin(list[0], chunk, chunks); at < end; ++at) {
    uint i = cells[list[1 + at]].begin;
    uint stop = i + cells[list[1 + at]].count;
    for (; i < stop; i += TRI_BATCH) {
      uint n = min(stop - i, (uint)TRI_BATCH);
      load_batch(spheres + 4 * (size_t)i, n, &batch);
      to_camera_space(&u, &batch);
#if TRI_STORED
      find_rectangles(&u, stored, i, n, &batch);
#else
      find_rectangles(&u, &batch);
#endif
      for (uint k = 0; k < n; ++k) {
        size_t particle = i + k;
        uint first = batch.first[k];
        uint last = batch.last[k];
        rectangles[2 * particle] = first;
        rectangles[2 * particle + 1] = last;
#if TRI_COUNT
        vertices += (uint)batch.corners[k];
        sprites += is_sprite(first, last, batch.corners[k]) ? 1 : 0;
#endif
        if (is_empty(first, last)) continue;
        vstore4((float4)(batch.x[k], batch.y[k], batch.z[k], batch.r[k]), particle, camera);
        into_bins(first, last, across, down, false, i + k, cursors, 0, 0);
      }
    }
  }
#if TRI_COUNT
  counters[8 * chunk + TRI_COUNT_SPRITES] += sprites;
  counters[8 * chunk + TRI_COUNT_VERTICES] += vertices;
#endif
}

__kernel void fill_bins(__global const Particles* restrict parameters,
                        __global const Cell* restrict cells, __global const uint* restrict list,
                        __global const uint* restrict rectangles, uint bins,
                        __global uint* restrict counts, __global const uint* restrict begins,
                        __global uint* restrict entries) {
  uint chunk = (uint)get_global_id(0);
  uint chunks = (uint)get_global_size(0);
  Particles u = *parameters;
  int across = tiles_across(&u);
  int down = tiles_down(&u);
  __global uint* cursors = counts + (size_t)bins * chunk;
  uint end = chunk_begin(list[0], chunk + 1, chunks);
  for (uint at = chunk_begin(list[0], chunk, chunks); at < end; ++at) {
    uint begin = cells[list[1 + at]].begin;
    uint n = cells[list[1 + at]].count;
    for (uint i = begin; i < begin + n; ++i) {
      uint first = rectangles[2 * (size_t)i];
      uint last = rectangles[2 * (size_t)i + 1];
      if (is_empty(first, last)) continue;
      into_bins(first, last, across, down, true, i, cursors, begins, entries);
    }
  }
}
