// Each block of tiles is an instance with four vertices. They form the rectangle around the tiles of the block
// that contain spheres, or an empty rectangle if there are none.

void main() {
  ivec2 grid = tile_grid();
  int columns = (grid.x + TRI_BLOCK - 1) / TRI_BLOCK;
  ivec2 first = TRI_BLOCK * ivec2(TRI_INSTANCE % columns, TRI_INSTANCE / columns);
  ivec2 end = min(first + TRI_BLOCK, grid);
  ivec2 low = end;
  ivec2 high = first;
  for (int y = first.y; y < end.y; ++y) {
    for (int x = first.x; x < end.x; ++x) {
      ivec2 tile = ivec2(x, y);
      if ((tile_state(tile_index(tile)).w & TRI_USED) != 0u) {
        low = min(low, tile);
        high = max(high, tile + 1);
      }
    }
  }
  ivec2 corner = ivec2((TRI_CORNER & 1) == 0 ? low.x : high.x, TRI_CORNER < 2 ? low.y : high.y);
  vec2 place = vec2(min(TRI_TILE * corner, u.viewport.xy)) / vec2(u.viewport.xy);
  gl_Position = low.x < high.x ? vec4(2.0 * place - 1.0, 0.5, 1.0) : vec4(2.0, 2.0, 0.0, 1.0);
}
