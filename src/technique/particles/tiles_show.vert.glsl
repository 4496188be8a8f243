// One instance of four vertices per block of tiles; a block that nothing was ever drawn into is nowhere.

void main() {
  ivec2 grid = tile_grid();
  int columns = (grid.x + TRI_BLOCK - 1) / TRI_BLOCK;
  ivec2 first = TRI_BLOCK * ivec2(TRI_INSTANCE % columns, TRI_INSTANCE / columns);
  ivec2 end = min(first + TRI_BLOCK, grid);
  bool empty = true;
  for (int y = first.y; y < end.y; ++y) {
    for (int x = first.x; x < end.x; ++x) {
      if ((tile_state(tile_index(ivec2(x, y))).w & TRI_USED) != 0u) empty = false;
    }
  }
  ivec2 corner = ivec2((TRI_CORNER & 1) == 0 ? first.x : end.x, TRI_CORNER < 2 ? first.y : end.y);
  vec2 place = vec2(min(TRI_TILE * corner, u.viewport.xy)) / vec2(u.viewport.xy);
  gl_Position = empty ? vec4(2.0, 2.0, 0.0, 1.0) : vec4(2.0 * place - 1.0, 0.5, 1.0);
}
