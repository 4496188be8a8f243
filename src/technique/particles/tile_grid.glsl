// Declarations that all passes of the technique `tiles` share: the grid of tiles, and all read-only data. tiles.glsl
// lists the passes, and explains rounds and entries. Include this after keys.glsl. The data are read as texels, because
// a software device fetches texels for all lanes at once but loads from storage buffers lane by lane.

#define TRI_TILE 16             // number of pixels along the edge of a tile
#define TRI_SMALL_EDGE 6        // maximum edge, in pixels, of a small sphere's rectangle; llvmpipe is fastest with 6
#define TRI_BLOCK 4             // number of tiles along the edge of a block that tiles_show draws as one quad
#define TRI_PARTICLE_BITS 28    // number of bits of an entry that contain the particle's index

TRI_BINDING(13) uniform samplerBuffer camera_texels;  // spheres in camera space, indexed by particle
TRI_BINDING(14) uniform usamplerBuffer tile_texels;   // a header, then all tiles, with two texels each
TRI_BINDING(15) uniform usamplerBuffer entry_texels;
TRI_BINDING(16) uniform usamplerBuffer pixel_texels;  // small spheres: a plane of depth keys, then one of particle keys
TRI_BINDING(18) uniform usamplerBuffer colour_texels;  // 1 or 4 words per particle
#define TRI_COLOUR_WORD(n) texelFetch(colour_texels, int(n)).x

int plane_size() { return u.viewport.x * u.viewport.y; }
ivec2 tile_grid() { return (u.viewport.xy + (TRI_TILE - 1)) / TRI_TILE; }
int pixel_index(ivec2 pixel) { return pixel.y * u.viewport.x + pixel.x; }
int tile_index(ivec2 tile) { return tile.y * tile_grid().x + tile.x; }

// Returns the state of a tile: the number of its entries (the large spheres that reach it) in the current round, the
// index after the last of these entries, the smallest depth key of its pixels (0 while a pixel is empty), and flags.
uvec4 tile_state(int index) { return texelFetch(tile_texels, 2 + 2 * index); }
uint farthest_in(int index) { return tile_state(index).z; }
#define TRI_USED 1u       // a sphere may have been drawn into the tile
#define TRI_TOUCHED 2u    // small spheres may have been drawn into the tile in this round
#define TRI_HAS_LARGE 4u  // large_pixels contains the results of earlier rounds

// The bits of TRI_SPHERES, which describe the kinds of spheres in the scene (technique::TileRounds).
#define TRI_SMALL 1     // small spheres
#define TRI_LARGE 2     // large spheres
#define TRI_RESOLVED 4  // tiles_resolve draws large spheres; tiles_show reads them from large_pixels

// The depth keys and particle keys of large spheres. One texel contains the keys of two vertically adjacent pixels.
#ifndef TRI_LARGE_PIXELS
#define TRI_LARGE_PIXELS 20
#endif
TRI_BINDING(TRI_LARGE_PIXELS) layout(rgba32ui) uniform uimage2D large_pixels;

uint particle_of(uint entry) { return entry & (1u << TRI_PARTICLE_BITS) - 1u; }
