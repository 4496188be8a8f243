#include "technique/volume/extra_work.hpp"

#include <algorithm>

#include "technique/portable/prelude.hpp"

namespace triptych::technique {

std::vector<ExtraTile> extra_tiles(int width, int height, int stride) {
  std::vector<ExtraTile> tiles;
  const int again = again_from(width);
  for (int y = 0; y < height; y += extra_tile_height) {
    for (int column = again; column < drawn_columns(width, stride); column += extra_tile_width) {
      const int x = portable::tri_drawn_column(column, y, again, stride);
      if (x >= width) continue;
      tiles.push_back(
          {x, y, std::min(extra_tile_width, width - x), std::min(extra_tile_height, height - y)});
    }
  }
  return tiles;
}

}  // namespace triptych::technique
