// One ray per fragment. Row 0 of the target is the picture's top row; row y is image row
// tri_drawn_row(y): y itself for the picture, others for planted extra work.
out vec4 colour;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  pixel.y = tri_drawn_row(pixel.x, pixel.y, u.viewport.z);
  colour = pixel.y < u.viewport.y ? raycast(pixel) : vec4(0);
}
