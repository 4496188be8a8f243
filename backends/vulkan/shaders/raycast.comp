#version 450
#extension GL_GOOGLE_include_directive : require
// Traces one ray per invocation. A specialization constant turns it into speed_of_light.
#include "prelude.glsl"
#include "portable/prelude.glsl"
#include "portable/volume_math.h"
#include "portable/volume_preintegration.h"
#include "volume/raycast/parameters.glsl"
#if TRI_CELLS
#include "volume/raycast/raycast_cells.glsl"
#else
#include "volume/raycast/preintegrated.glsl"
#include "volume/raycast/raycast.glsl"
#endif

// A work group draws a tile of 8×8 pixels. Any 8, 16 or 32 consecutive invocations that a device
// may run in lockstep draw a compact block of the tile, because neighbouring rays take similar
// paths.
layout(local_size_x = 64) in;

ivec2 pixel_in_tile(int i) {
  return ivec2((i & 3) | (i >> 2 & 4), (i >> 2 & 3) | (i >> 3 & 4));
}

layout(std430) TRI_BINDING(4) writeonly buffer Output { vec4 image[]; };  // top row first

void main() {
  ivec2 at = 8 * ivec2(gl_WorkGroupID.xy) + pixel_in_tile(int(gl_LocalInvocationIndex));
  ivec2 pixel = ivec2(tri_drawn_column(at.x, at.y, u.viewport.w, u.viewport.z), at.y);
  if (pixel.x >= u.viewport.x || pixel.y >= u.viewport.y) return;
  int columns = 8 * int(gl_NumWorkGroups.x);
#if TRI_PARTS
  int place = tri_output_place(at.x, at.y, u.viewport.x, u.viewport.y, u.viewport.w, columns);
  image[place] = raycast_part(pixel, place);
#else
  image[tri_output_place(at.x, at.y, u.viewport.x, u.viewport.y, u.viewport.w, columns)] = raycast(pixel);
#endif
}
