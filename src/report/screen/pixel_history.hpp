#pragma once
// The output of `render --pixel`: the history of one pixel.

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
  PixelColour image{};  // the colour in the device's image
  // The colour in a second frame, which was drawn by a build of the device code that also records
  // the samples.
  std::optional<PixelColour> recorded{};
  PixelColour reference{};
  double bound = 0;        // the error bound, which is the same for all channels
  std::uint64_t lost = 0;  // number of samples that did not fit into the recording buffer
};

// The text about a pixel. `summary` contains its colours and the first difference between the
// device and the reference. `table` lists the samples or the spheres along the pixel's ray.
struct PixelText {
  std::vector<std::string> summary;
  std::vector<std::string> table;  // the first line is the heading
  std::size_t marked = 0;          // the index of the marked line of the table; 0: none is marked
};
[[nodiscard]] PixelText pixel_text(const PixelInImage& pixel, const accuracy::RayHistory& history);
// Returns whether the colour of the pixel in the device's image is within its bound.
[[nodiscard]] bool is_within_bound(const PixelInImage& pixel);
// Returns the text for a pixel of a particle scene. Its table contains the spheres that the pixel's
// ray may hit.
[[nodiscard]] PixelText pixel_text(const PixelInImage& pixel,
                                   const accuracy::SpriteHistory& history);

// Returns the heading of the table and at most `most` lines around the marked line. States how many
// lines are left out.
[[nodiscard]] std::vector<std::string> part_of_table(const PixelText& text, std::size_t most);

}  // namespace triptych::report
