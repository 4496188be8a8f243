// One ray per invocation. Row y of the grid is image row y·stride: 1 for the picture, more for planted
// extra work.
layout(local_size_x = TRI_GROUP_WIDTH, local_size_y = TRI_GROUP_HEIGHT) in;
layout(std430) TRI_BINDING(4) writeonly buffer Pixels { vec4 pixels[]; };  // top row first

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) * ivec2(1, u.viewport.z);
  if (pixel.x >= u.viewport.x || pixel.y >= u.viewport.y) return;
  pixels[pixel.y * u.viewport.x + pixel.x] = raycast(pixel);
}
