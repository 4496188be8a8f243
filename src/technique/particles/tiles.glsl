// What the compute passes of `tiles` share. A frame goes through the cells front to back in rounds; in each
//   tiles_cells    says which cells of the round are drawn,
//   tiles_bin      finds the pixels of every particle in them: those of small ones are drawn at once, one
//                  invocation per sphere, by an atomic maximum on each pixel's depth; large ones are counted
//                  for each tile they reach,
//   tiles_place    lists the tiles that this round draws into, and gives each a place for its entries,
//   tiles_fill     writes the entries,
//   tiles_resolve  draws the entries of the listed tiles, a few invocations each,
//   tiles_settle   notes the farthest depth of each, by which later rounds leave out what is hidden;
// and in the end
//   tiles_index    finds the lowest particle at each pixel's depth among the small ones,
//   tiles_show     colours every pixel once, as a fragment shader on blocks of tiles that hold something.
// Few spheres are drawn at once: nothing is resolved or settled, tiles_show goes through the entries itself.
// A tile that holds nothing costs nothing. No pass waits within a work group, and pixels leave as vectors: through
// images and the rasterizer. Devices without vectors of their own loads take storage buffers word by word.
// Everything a pixel keeps is a maximum of keys (depth) and a minimum of keys (particle), so that the
// picture does not depend on the order of anything.
//
// The backend gives TRI_ROUND, a uvec2: first cell and number of cells, and TRI_CULLING
// (technique::Culling), both of which may vary at run time.

#define TRI_MOST_GROUPS 65535u  // along one axis of a dispatch

struct Tile {
  uint entries;   // tile_state()
  uint next;      // where the next entry goes; after tiles_fill the end of them
  uint farthest;
  uint flags;
  uint coming;    // farthest, after this round
  uint listed;    // the n-th tile that is drawn into in this round
  uint no_state[2];
};

layout(std430) TRI_BINDING(7) writeonly buffer CameraSpheres { vec4 camera_spheres[]; };  // by particle
// Particles: small ones of all rounds from the front, large ones of this round from the back.
layout(std430) TRI_BINDING(8) buffer Kept { uint kept[]; };
layout(std430) TRI_BINDING(9) buffer Tiles {
  uint small_kept;
  uint large_kept;
  uint placed_entries;
  uint tiles_listed;
  uint groups[4];  // for tiles_resolve, as an indirect dispatch reads them
  Tile tiles[];
};
layout(std430) TRI_BINDING(10) buffer Entries { uint entries[]; };
layout(std430) TRI_BINDING(11) buffer Pixels { uint pixels[]; };

uint large_place(uint n) { return uint(kept.length()) - 1u - n; }
uint depth_seen(ivec2 pixel) { return texelFetch(pixel_texels, pixel_index(pixel)).x; }

// Pixels x, y, width, height whose centres the sphere's silhouette may cover; width 0 for none. Precise, as
// front_key is: tiles_fill has room for the entries that tiles_bin counted, and no others.
ivec4 pixel_rectangle(vec4 sphere) {
  vec2 low;
  vec2 high;
  image_bounds(sphere, low, high);
  vec2 size = vec2(u.viewport.xy);
  // Pixel (x, y) looks through ((x + ½)·plane.z − plane.x, plane.y − (y + ½)·plane.w).
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

// A depth key that none of the sphere's surface exceeds. A device's depth errs by a few 2⁻²⁴ of the
// distance of the farthest part (tri_sphere_distance); 2⁻¹⁶ is more than it can be.
uint front_key(vec4 sphere) {
  if (TRI_FAULT == 3) return TRI_LARGEST_KEY;  // nothing is left out
  TRI_PRECISE float rounding = 1.5259e-5 * (abs(sphere.x) + abs(sphere.y) + abs(sphere.z) + sphere.w);
  TRI_PRECISE float front = sphere.z + (TRI_FAULT == 4 ? sphere.w : -sphere.w) - rounding;
  return front > 0.0 ? depth_key(tri_depth(u.eye.w, front)) : TRI_LARGEST_KEY;
}

// The up to 2×2 tiles that a small rectangle touches, some of them more than once.
ivec4 tiles_around(ivec4 rectangle) {
  ivec2 a = rectangle.xy / TRI_TILE;
  ivec2 b = (rectangle.xy + rectangle.zw - 1) / TRI_TILE;
  return ivec4(tile_index(a), tile_index(b), tile_index(ivec2(a.x, b.y)), tile_index(ivec2(b.x, a.y)));
}

// Their farthest depth key.
uint farthest_around(ivec4 rectangle) {
  ivec4 around = tiles_around(rectangle);
  return min(min(farthest_in(around.x), farthest_in(around.y)),
             min(farthest_in(around.z), farthest_in(around.w)));
}

// A small rectangle has at most 2×2 tiles: no side is longer than a tile.
bool is_small(ivec4 rectangle) { return max(rectangle.z, rectangle.w) <= TRI_SMALL_EDGE; }
