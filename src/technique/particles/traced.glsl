// The result of tracing rays for each pixel: two planes of keys (keys.glsl), one of depths and one of particles.
layout(std430) TRI_BINDING(11) buffer Pixels { uint pixels[]; };

// Counters that use the columns of the sprites' counters.
#define TRI_COUNT_NODES 0
#define TRI_COUNT_BOXES 1
#define TRI_COUNT_INTERSECTIONS 2

int plane_size() { return u.viewport.x * u.viewport.y; }
int pixel_index(ivec2 pixel) { return pixel.y * u.viewport.x + pixel.x; }
