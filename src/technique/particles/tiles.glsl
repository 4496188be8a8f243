// What the passes of `tiles` share. A frame goes through the cells front to back in rounds; in each
//   tiles_cells    says which cells of the round are drawn,
//   tiles_bin      finds the pixels of every particle in them: those of small ones are drawn at once, one
//                  invocation per sphere, by an atomic maximum on each pixel's depth; large ones are counted
//                  for each tile they reach,
//   tiles_place    gives each tile a place for its entries,
//   tiles_fill     writes the entries,
//   tiles_resolve  draws a tile's entries, one work group per tile, and notes the tile's farthest depth, by
//                  which later rounds leave out what is hidden (tiles_farthest: the latter alone);
// and in the end
//   tiles_index    finds the lowest particle at each pixel's depth among the small ones,
//   tiles_shade    colours every pixel once.
// Everything a pixel keeps is a maximum of keys (depth) and a minimum of keys (particle), so that the
// picture does not depend on the order of anything.
//
// The backend gives TRI_ROUND, a uvec2: first cell and number of cells, and TRI_CULLING
// (technique::Culling), both of which may vary at run time.

#define TRI_TILE 16             // pixels along a tile's edge
#define TRI_LARGEST_KEY 0xFFFFFFFFu

struct Tile {
  uint entries;   // in this round
  uint next;      // where the next entry goes; after tiles_fill the end of them
  uint farthest;  // smallest depth key of its pixels: 0 while one is empty
  uint unused;
};

// Spheres in camera space with their index in the arrangement: small ones of all rounds from the front,
// large ones of this round from the back.
layout(std430) TRI_BINDING(7) buffer KeptSpheres { vec4 kept_spheres[]; };
layout(std430) TRI_BINDING(8) buffer Kept { uint kept[]; };
layout(std430) TRI_BINDING(9) buffer Tiles {
  uint small_kept;
  uint large_kept;
  uint placed_entries;
  uint no_state;
  Tile tiles[];
};
layout(std430) TRI_BINDING(10) buffer Entries { uint entries[]; };  // places in kept_spheres
// Four planes of one word per pixel: depth key; particle key among the small; depth key and particle key
// among the large. In the end: depth, id.
layout(std430) TRI_BINDING(11) buffer Pixels { uint pixels[]; };

uint plane_size() { return uint(u.viewport.x * u.viewport.y); }
ivec2 tile_grid() { return (u.viewport.xy + (TRI_TILE - 1)) / TRI_TILE; }
uint pixel_index(ivec2 pixel) { return uint(pixel.y * u.viewport.x + pixel.x); }
uint tile_index(ivec2 tile) { return uint(tile.y * tile_grid().x + tile.x); }
uint large_place(uint n) { return uint(kept_spheres.length()) - 1u - n; }

// Keys: the nearest depth has the largest, 0 is none; the first particle has the smallest. The planted
// faults turn them round: 2 unresolved ties, 3 reversed depth, 4 the sphere's back for its front, 6 lost at
// a tile's border, 7 a missing barrier.
uint depth_key(float depth) {
  uint bits = floatBitsToUint(depth);
  return TRI_FAULT == 3 ? ~bits : bits;
}
float depth_of_key(uint key) { return uintBitsToFloat(TRI_FAULT == 3 ? ~key : key); }
uint particle_key(uint particle) { return TRI_FAULT == 2 ? ~particle & 0x7FFFFFFFu : particle; }
uint particle_of_key(uint key) { return TRI_FAULT == 2 ? ~key & 0x7FFFFFFFu : key; }

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

// The depth key of the sphere in this pixel, 0 where the ray misses it.
uint sphere_key(vec4 c, ivec2 pixel) {
  vec2 s = pixel_ray(pixel);
  float discriminant = tri_sphere_discriminant(c.x, c.y, c.z, c.w, s.x, s.y);
  float distance = tri_sphere_distance(c.x, c.y, c.z, s.x, s.y, max(discriminant, 0.0));
  return discriminant >= 0.0 && distance > 0.0 ? depth_key(tri_depth(u.eye.w, distance)) : 0u;
}

// Farthest depth key of the up to 2×2 tiles that a small rectangle touches.
uint farthest_around(ivec4 rectangle) {
  ivec2 a = rectangle.xy / TRI_TILE;
  ivec2 b = (rectangle.xy + rectangle.zw - 1) / TRI_TILE;
  return min(min(tiles[tile_index(a)].farthest, tiles[tile_index(b)].farthest),
             min(tiles[tile_index(ivec2(a.x, b.y))].farthest, tiles[tile_index(ivec2(b.x, a.y))].farthest));
}

// A small rectangle has at most 2×2 tiles: no side is longer than a tile.
bool is_small(ivec4 rectangle) { return max(rectangle.z, rectangle.w) <= TRI_TILE; }
