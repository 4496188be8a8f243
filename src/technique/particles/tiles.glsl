// Declarations that the compute passes of the technique `tiles` share. A frame processes the cells (groups of
// neighbouring particles, cells.glsl) from front to back in rounds. An entry is a pair of a tile and a large sphere
// that reaches this tile. In each round
//   tiles_cells    decides which cells of the round are drawn,
//   tiles_bin      finds the pixels of every particle in these cells. It draws small spheres at once, with one
//                  invocation per sphere, by an atomic maximum on each pixel's depth. It counts the entries of each
//                  tile,
//   tiles_place    lists the tiles that this round draws into, and reserves space for their entries,
//   tiles_fill     writes the entries,
//   tiles_resolve  draws the entries of the listed tiles, with a few invocations for each tile,
//   tiles_settle   stores the farthest depth of each tile, which later rounds use to skip hidden spheres.
// At the end of the frame
//   tiles_index    finds, among the small spheres at each pixel's depth, the particle with the lowest index,
//   tiles_show     colours every pixel once, as a fragment shader on blocks of tiles that are not empty.
// If there are few spheres, tiles_resolve and tiles_settle are not run, and tiles_show loops over the entries itself.
// An empty tile costs nothing. No pass uses work-group barriers. Pixels are written as vectors, through images and
// the rasterizer, because devices without vector loads access storage buffers word by word. A pixel stores the
// maximum of the depth keys and the minimum of the particle keys at that depth, so the image does not depend on the
// order of processing.
//
// The backend defines TRI_ROUND, a uvec2 with the index of the first cell and the number of cells, and TRI_CULLING
// (technique::Culling). Both may be run-time values.

#define TRI_MOST_GROUPS 65535u  // maximum number of work groups along one axis of a dispatch

struct Tile {
  uint entries;   // see tile_state()
  uint next;      // index at which the next entry is written; after tiles_fill, the end of the tile's entries
  uint farthest;
  uint flags;
  uint coming;    // value of `farthest` after this round
  uint listed;    // in element n: the index of the n-th tile that this round draws into
  uint no_state[2];
};

layout(std430) TRI_BINDING(7) writeonly buffer CameraSpheres { vec4 camera_spheres[]; };  // indexed by particle
// Indices of the particles that may be visible. Small spheres of all rounds are stored from the front of the buffer on,
// and large spheres of the current round from its back.
layout(std430) TRI_BINDING(8) buffer Kept { uint kept[]; };
layout(std430) TRI_BINDING(9) buffer Tiles {
  uint small_kept;
  uint large_kept;
  uint placed_entries;
  uint tiles_listed;
  uint groups[4];  // number of work groups of tiles_resolve, in the layout of an indirect dispatch
  Tile tiles[];
};
layout(std430) TRI_BINDING(10) buffer Entries { uint entries[]; };
layout(std430) TRI_BINDING(11) buffer Pixels { uint pixels[]; };

uint large_place(uint n) { return uint(kept.length()) - 1u - n; }
uint depth_seen(ivec2 pixel) { return texelFetch(pixel_texels, pixel_index(pixel)).x; }

// Returns the rectangle of pixels (x, y, width, height) whose centres the sphere's silhouette may cover; the width is
// 0 if there are no such pixels. The arithmetic is `precise`, as in front_key, so that tiles_fill writes exactly the
// entries that tiles_bin counted and for which tiles_place reserved space.
ivec4 pixel_rectangle(vec4 sphere) {
  vec2 low;
  vec2 high;
  image_bounds(sphere, low, high);
  vec2 size = vec2(u.viewport.xy);
  // The ray of pixel (x, y) passes through the point ((x + ½)·plane.z − plane.x, plane.y − (y + ½)·plane.w) of the
  // image plane.
  TRI_PRECISE vec2 first = vec2(low.x + u.plane.x, u.plane.y - high.y) / u.plane.zw - 0.5;
  TRI_PRECISE vec2 last = vec2(high.x + u.plane.x, u.plane.y - low.y) / u.plane.zw - 0.5;
  ivec2 begin = ivec2(clamp(ceil(first), vec2(0.0), size));
  ivec2 end = ivec2(clamp(floor(last) + 1.0, vec2(0.0), size));
  if (TRI_FAULT == 6) {
    ivec2 border = (end - 1) / TRI_TILE * TRI_TILE;
    end = ivec2(begin.x < border.x ? border.x : end.x, begin.y < border.y ? border.y : end.y);
  }
  ivec2 extent = end - begin;
  return extent.x > 0 && extent.y > 0 ? ivec4(begin, extent) : ivec4(0);
}

// Returns a depth key that no point of the sphere's surface exceeds. Depths computed on a device have an error of a
// few 2⁻²⁴ of the distance to the sphere's farthest part (tri_sphere_distance), so 2⁻¹⁶ is more than enough.
uint front_key(vec4 sphere) {
  if (TRI_FAULT == 3) return TRI_LARGEST_KEY;  // with this fault, no sphere is skipped
  TRI_PRECISE float rounding = 1.5259e-5 * (abs(sphere.x) + abs(sphere.y) + abs(sphere.z) + sphere.w);
  TRI_PRECISE float front = sphere.z + (TRI_FAULT == 4 ? sphere.w : -sphere.w) - rounding;
  return front > 0.0 ? depth_key(tri_depth(u.eye.w, front)) : TRI_LARGEST_KEY;
}

// Returns the indices of the tiles, at most 2×2, that a small rectangle overlaps. An index may occur more than once.
ivec4 tiles_around(ivec4 rectangle) {
  ivec2 a = rectangle.xy / TRI_TILE;
  ivec2 b = (rectangle.xy + rectangle.zw - 1) / TRI_TILE;
  return ivec4(tile_index(a), tile_index(b), tile_index(ivec2(a.x, b.y)), tile_index(ivec2(b.x, a.y)));
}

// Returns the farthest depth key of the tiles that a small rectangle overlaps.
uint farthest_around(ivec4 rectangle) {
  ivec4 around = tiles_around(rectangle);
  return min(min(farthest_in(around.x), farthest_in(around.y)),
             min(farthest_in(around.z), farthest_in(around.w)));
}

// Returns whether a rectangle is small. A small rectangle overlaps at most 2×2 tiles, because its sides are shorter
// than a tile.
bool is_small(ivec4 rectangle) { return max(rectangle.z, rectangle.w) <= TRI_SMALL_EDGE; }
