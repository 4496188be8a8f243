// The results of tracing a ray for each pixel: a plane of depth keys, then a plane of particle keys (keys.glsl).
layout(std430) TRI_BINDING(11) buffer Pixels { uint pixels[]; };

// These counters use the columns that other techniques use for sprites (technique::ParticleCounter).
#define TRI_COUNT_NODES 0
#define TRI_COUNT_BOXES 1
#define TRI_COUNT_INTERSECTIONS 2

int plane_size() { return u.viewport.x * u.viewport.y; }
int pixel_index(ivec2 pixel) { return pixel.y * u.viewport.x + pixel.x; }
