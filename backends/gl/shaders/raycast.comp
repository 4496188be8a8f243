// One ray per invocation. Row y of the grid is image row tri_drawn_row(y): y itself for the picture,
// others for planted extra work. A group takes 8×8 pixels in Z order, so that any 4, 8, 16 or 32 consecutive invocations,
// whichever a device runs in step, are a compact block: neighbouring rays walk alike.
layout(local_size_x = 64) in;
layout(std430) TRI_BINDING(4) writeonly buffer Pixels { vec4 pixels[]; };  // top row first

ivec2 pixel_of_group(int i) {
  return ivec2((i & 1) | (i >> 1 & 2) | (i >> 2 & 4), (i >> 1 & 1) | (i >> 2 & 2) | (i >> 3 & 4));
}

void main() {
  ivec2 pixel = 8 * ivec2(gl_WorkGroupID.xy) + pixel_of_group(int(gl_LocalInvocationIndex));
  pixel.y = tri_drawn_row(pixel.x, pixel.y, u.viewport.z);
  if (pixel.x >= u.viewport.x || pixel.y >= u.viewport.y) return;
  pixels[pixel.y * u.viewport.x + pixel.x] = raycast(pixel);
}
