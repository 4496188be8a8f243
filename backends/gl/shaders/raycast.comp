// Traces one ray per invocation. Column x of the grid draws image column tri_drawn_column(x): x
// itself for the image, and a neighbouring column for injected extra work. A work group covers 8×8
// pixels in Z order, so that any 4, 8, 16 or 32 consecutive invocations that a device runs in
// lockstep form a compact block. Their rays pass through similar parts of the volume.
layout(local_size_x = 64) in;
layout(std430) TRI_BINDING(4) writeonly buffer Pixels { vec4 pixels[]; };  // top row first

ivec2 pixel_of_group(int i) {
  return ivec2((i & 1) | (i >> 1 & 2) | (i >> 2 & 4), (i >> 1 & 1) | (i >> 2 & 2) | (i >> 3 & 4));
}

void main() {
  ivec2 at = 8 * ivec2(gl_WorkGroupID.xy) + pixel_of_group(int(gl_LocalInvocationIndex));
  ivec2 pixel = ivec2(tri_drawn_column(at.x, at.y, u.viewport.w, u.viewport.z), at.y);
  if (pixel.x >= u.viewport.x || pixel.y >= u.viewport.y) return;
  int columns = 8 * int(gl_NumWorkGroups.x);
#if TRI_PARTS
  int place = tri_output_place(at.x, at.y, u.viewport.x, u.viewport.y, u.viewport.w, columns);
  pixels[place] = raycast_part(pixel, place);
#else
  pixels[tri_output_place(at.x, at.y, u.viewport.x, u.viewport.y, u.viewport.w, columns)] = raycast(pixel);
#endif
}
