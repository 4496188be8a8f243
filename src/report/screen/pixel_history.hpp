#pragma once
// The history of one pixel as text, for `render --pixel`.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/ray_history.hpp"
#include "accuracy/sprite_history.hpp"

namespace triptych::report {

using PixelColour = std::array<float, 4>;  // premultiplied RGBA

struct PixelInImage {
  int x = 0;
  int y = 0;
  PixelColour image{};                    // the colour in the image of the timed build
  std::optional<PixelColour> recorded{};  // the colour from the build that records the samples
  PixelColour reference{};
  double bound = 0;        // the bound for any channel
  std::uint64_t lost = 0;  // records that did not fit into the buffer
};

// The colours of the pixel, the first difference, and the table of its samples.
struct PixelText {
  std::vector<std::string> summary;
  std::vector<std::string> table;  // the heading is the first line
  std::size_t marked = 0;          // the line of the table that is marked; 0: none
};
[[nodiscard]] PixelText pixel_text(const PixelInImage& pixel, const accuracy::RayHistory& history);
// The same for the spheres that the pixel's ray may meet.
[[nodiscard]] PixelText pixel_text(const PixelInImage& pixel,
                                   const accuracy::SpriteHistory& history);

// The heading and at most `most` lines of the table around the marked one, with a line about the
// lines that were left out.
[[nodiscard]] std::vector<std::string> part_of_table(const PixelText& text, std::size_t most);

}  // namespace triptych::report
