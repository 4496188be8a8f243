#version 450
#extension GL_GOOGLE_include_directive : require
// One invocation per pixel. Also speed_of_light, by its specialization constant.
#include "prelude.glsl"
#include "portable/prelude.glsl"
#include "portable/volume_math.h"
#include "volume/raycast/parameters.glsl"
#include "volume/raycast/raycast.glsl"

layout(local_size_x_id = 10, local_size_y_id = 11) in;

layout(std430) TRI_BINDING(4) writeonly buffer Output { vec4 image[]; };  // top row first

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  pixel.y *= u.viewport.z;
  if (pixel.x < u.viewport.x && pixel.y < u.viewport.y) image[pixel.y * u.viewport.x + pixel.x] = raycast(pixel);
}
