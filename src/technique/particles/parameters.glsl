// The layout is the same as that of technique::ParticleParameters (particle_parameters.hpp), which explains each
// field. The backend's prelude defines
//   TRI_BINDING(n)                 the binding of block n
//   TRI_LINK(n)                    the location of a variable between stages, if the language has locations
//   TRI_COLOUR                     0 rgba8, 1 rgba32, 2 intensity
//   TRI_TRANSFER_AT_PIXEL, TRI_RAY_AT_VERTEX (0 or 1), TRI_FAULT (technique::ParticleFault)
// and the macro TRI_COUNT (0 or 1). The constants from TRI_COLOUR to TRI_FAULT may be specialization constants.
layout(std140) TRI_BINDING(0) uniform Parameters {
  vec4 eye;
  vec4 eye_rest;
  vec4 right;
  vec4 right_rest;
  vec4 up;
  vec4 up_rest;
  vec4 forward;
  vec4 forward_rest;
  vec4 plane;
  vec4 shading;
  vec4 background;
  ivec4 viewport;
  uvec4 counts;
} u;
layout(std140) TRI_BINDING(1) uniform Transfer { vec4 transfer_entries[256]; };

#if TRI_COUNT
// There are 1024 rows of 8 counters, and the host sums the rows. A single row would cause contention and could
// overflow.
layout(std430) TRI_BINDING(2) buffer Counters { uint counters[]; };
#define TRI_COUNT_SPRITES 0
#define TRI_COUNT_VERTICES 1
#define TRI_COUNT_FRAGMENTS 2
#define TRI_COUNT_DISCARDED 3
#define TRI_COUNT_BIN_ENTRIES 4
#define TRI_COUNT_SUBMITTED 5
#define TRI_COUNT_CELLS_CULLED 6
void add_count(int what, uint row, uint amount) {
  atomicAdd(counters[8u * (row & 1023u) + uint(what)], amount);
}
#endif
