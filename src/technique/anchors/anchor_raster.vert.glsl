// Triptych anchor_raster, version 1. FROZEN: never changed; see technique/anchors/shape.hpp.
// Half a rectangle of 32 by 31 pixels in each cell of a layer; which half, goes round with the cells.
void main() {
  uint vertex = uint(TRI_VERTEX);
  uint triangle = vertex / 3u;
  uint layer = triangle / 961u;
  uint cell = triangle - 961u * layer;
  uvec2 origin = 32u * uvec2(cell % 31u, cell / 31u) + (uvec2(5u * layer, 7u * layer) & 31u);
  uint left_out = (cell + layer) & 3u;
  uint corner = vertex - 3u * triangle;
  if (corner >= left_out) ++corner;
  uvec2 pixel = origin + uvec2(32u * (corner & 1u), 31u * (corner >> 1));
  gl_Position = vec4(vec2(pixel) * (1.0 / 512.0) - 1.0, 0.0, 1.0);
}
