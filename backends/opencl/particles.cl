// Mirrors technique::ParticleParameters and technique::Cell, which explain each field.
typedef struct {
  float4 eye;
  float4 eye_rest;
  float4 right;
  float4 right_rest;
  float4 up;
  float4 up_rest;
  float4 forward;
  float4 forward_rest;
  float4 plane;
  float4 shading;
  float4 background;
  int4 viewport;
  uint4 counts;
} Particles;

typedef struct {
  float lo[3];
  uint begin;
  float hi[3];
  uint count;
} Cell;

// Compile-time constants of all programs: TRI_COUNT (0 or 1), TRI_FAULT (technique::ParticleFault),
// TRI_TILE and TRI_TILE_SHIFT (the edge of a tile in pixels, and its binary logarithm). For bins
// and tiles: TRI_SPRITE (how to find the pixels of a particle, see particle_sprite.cl),
// TRI_CONSERVATIVE_DEPTH, TRI_RAY_AT_VERTEX (0 or 1). For shading: TRI_COLOUR (0 rgba8, 1 rgba32, 2
// intensity), TRI_TRANSFER_AT_PIXEL, TRI_RAY_AT_VERTEX.
#define TRI_UNRESOLVED_TIES (TRI_FAULT == 2)
#define TRI_REVERSED_DEPTH (TRI_FAULT == 3)
#define TRI_WRONG_SENSE (TRI_FAULT == 4)
#define TRI_LOST_AT_BORDER (TRI_FAULT == 6)
#define TRI_MISSING_BARRIER (TRI_FAULT == 7)
#define TRI_SMALL_BOX (TRI_FAULT == 8)

#define TRI_NONE 0xFFFFFFFFu

// Columns of the counters, which have rows of 8. No two work items share a row, and the host adds
// the rows.
#define TRI_COUNT_SPRITES 0
#define TRI_COUNT_VERTICES 1
#define TRI_COUNT_FRAGMENTS 2
#define TRI_COUNT_DISCARDED 3
#define TRI_COUNT_BIN_ENTRIES 4
#define TRI_COUNT_SUBMITTED 5
#define TRI_COUNT_CELLS_CULLED 6
// Techniques that trace rays have no sprites, and use the same columns for their own counters.
#define TRI_COUNT_NODES 0
#define TRI_COUNT_BOXES 1
#define TRI_COUNT_INTERSECTIONS 2

// These functions return the components of a point's position in camera space.
TRI_FN float camera_x(const Particles* u, float x, float y, float z) {
  return tri_along_axis(x, y, z, u->eye.x, u->eye.y, u->eye.z, u->eye_rest.x, u->eye_rest.y,
                        u->eye_rest.z, u->right.x, u->right.y, u->right.z, u->right_rest.x,
                        u->right_rest.y, u->right_rest.z);
}
TRI_FN float camera_y(const Particles* u, float x, float y, float z) {
  return tri_along_axis(x, y, z, u->eye.x, u->eye.y, u->eye.z, u->eye_rest.x, u->eye_rest.y,
                        u->eye_rest.z, u->up.x, u->up.y, u->up.z, u->up_rest.x, u->up_rest.y,
                        u->up_rest.z);
}
TRI_FN float camera_z(const Particles* u, float x, float y, float z) {
  return tri_along_axis(x, y, z, u->eye.x, u->eye.y, u->eye.z, u->eye_rest.x, u->eye_rest.y,
                        u->eye_rest.z, u->forward.x, u->forward.y, u->forward.z,
                        u->forward_rest.x, u->forward_rest.y, u->forward_rest.z);
}

// These functions return the point where the ray through a pixel centre intersects the image plane.
// The first row is the top row.
TRI_FN float pixel_ray_x(const Particles* u, int x) {
  return ((float)x + 0.5f) * u->plane.z - u->plane.x;
}
TRI_FN float pixel_ray_y(const Particles* u, int y) {
  return u->plane.y - ((float)y + 0.5f) * u->plane.w;
}

// Returns the beginning of the range of listed cells that belongs to this work item.
TRI_FN uint chunk_begin(uint listed, uint chunk, uint chunks) {
  return (uint)((ulong)listed * chunk / chunks);
}
