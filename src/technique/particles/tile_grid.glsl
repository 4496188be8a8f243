// Shared by all passes of `tiles` (tiles.glsl lists them), to be included after keys.glsl. It contains the grid,
// and all data that are only read, as texels: a software device fetches texels for all lanes at once, but loads
// from storage buffers lane by lane.

#define TRI_TILE 16             // pixels along the edge of a tile
#define TRI_SMALL_EDGE 6        // largest edge of a small sphere's rectangle in pixels; llvmpipe is fastest with this
#define TRI_BLOCK 4             // tiles along the edge of a block that is drawn together
#define TRI_PARTICLE_BITS 28    // of an entry

TRI_BINDING(13) uniform samplerBuffer camera_texels;  // spheres in camera space, by particle
TRI_BINDING(14) uniform usamplerBuffer tile_texels;   // a header, then a Tile each, of two texels
TRI_BINDING(15) uniform usamplerBuffer entry_texels;
TRI_BINDING(16) uniform usamplerBuffer pixel_texels;  // two planes: depth key, particle key of small spheres
TRI_BINDING(18) uniform usamplerBuffer colour_texels;  // 1 or 4 words per particle
#define TRI_COLOUR_WORD(n) texelFetch(colour_texels, int(n)).x

int plane_size() { return u.viewport.x * u.viewport.y; }
ivec2 tile_grid() { return (u.viewport.xy + (TRI_TILE - 1)) / TRI_TILE; }
int pixel_index(ivec2 pixel) { return pixel.y * u.viewport.x + pixel.x; }
int tile_index(ivec2 tile) { return tile.y * tile_grid().x + tile.x; }

// A tile: the entries of this round, the end of them, the smallest depth key of its pixels (0 while one is empty),
// and flags.
uvec4 tile_state(int index) { return texelFetch(tile_texels, 2 + 2 * index); }
uint farthest_in(int index) { return tile_state(index).z; }
#define TRI_USED 1u       // something was drawn into it
#define TRI_TOUCHED 2u    // small spheres were drawn into it in this round
#define TRI_HAS_LARGE 4u  // large_pixels contains what earlier rounds have drawn

// What kinds of spheres the image may have, as bits of TRI_SPHERES (technique::TileRounds).
#define TRI_SMALL 1     // small
#define TRI_LARGE 2     // large
#define TRI_RESOLVED 4  // tiles_resolve draws the large ones, and tiles_show finds them in large_pixels

// The depth key and the particle key of large spheres: two rows of pixels in one.
#ifndef TRI_LARGE_PIXELS
#define TRI_LARGE_PIXELS 20
#endif
TRI_BINDING(TRI_LARGE_PIXELS) layout(rgba32ui) uniform uimage2D large_pixels;

uint particle_of(uint entry) { return entry & (1u << TRI_PARTICLE_BITS) - 1u; }
