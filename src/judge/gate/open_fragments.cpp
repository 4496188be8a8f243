#include "judge/gate/open_fragments.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "judge/baselines/frame_change.hpp"

namespace triptych::judge {
namespace {

// Where the API leaves the number open and the device does not tell, what was accepted has: eight
// bits, as has our own rasterizer for OpenCL.
constexpr double usual_bits = 8;

std::optional<double> told(const record::Record& record, const char* name) {
  const auto found = record.precision.find(name);
  return found == record.precision.end() ? std::nullopt : std::optional(found->second);
}

bool is_open(const std::string& counter, const record::Record& record) {
  if (counter == "fragments" || counter == "fragments_discarded") return true;
  // A ray that is made at the vertices moves with them, and with it the silhouette: who is in
  // sight.
  const auto ray = record.factors.find("ray");
  return (counter == "fragments_kept" || counter == "visible_ids") && ray != record.factors.end() &&
         ray->second == "vertex";
}

}  // namespace

// A driver moves each vertex to its grid of 2⁻ᵇ pixel, rounding or cutting off: by less than a
// step. Edges of one sprite by two drivers so lie 2⁻ᵇ + 2⁻⁸ pixel apart, and farther by what the
// sprite is larger on a coarse grid (technique/particles/margins.hpp): δ in all. A point is larger
// by its margin, half of it on each side, and by as much again where its size is rounded up. An
// edge that moves by δ passes δ·L centres of pixels on average, L its length. S sprites with F
// fragments have edges of at most 4·√(S·F) together (squares, by Cauchy and Schwarz; a polygon
// around the same disc has less), and four corners of δ². An edge along an axis passes all of its L
// centres or none, a variance of δ·L², and of 4·δ·F for all; m sprites in one place do it together:
// m times that, with m = S over the particles in sight. What is open is the mean and five standard
// deviations.
double open_fragments(const std::string& counter, const record::Record& record) {
  constexpr double deviations = 5;
  if (!is_open(counter, record)) return 0;
  const double bits = told(record, "sub_pixel_bits").value_or(usual_bits);
  const double larger =
      std::max(0.0, 2 * std::exp2(-bits) - 1.0 / 64) + told(record, "point_margin").value_or(0);
  const double apart = std::exp2(-bits) + std::exp2(-usual_bits) + larger;
  const double fragments = count_of(record.counters, "fragments").value_or(0);
  const double sprites = count_of(record.counters, "sprites").value_or(0);
  const double in_sight = count_of(record.counters, "visible_ids").value_or(0);
  const double together = std::max(1.0, sprites / std::max(1.0, in_sight));
  return apart * 4 * std::sqrt(sprites * fragments) + 4 * apart * apart * sprites +
         deviations * std::sqrt(4 * apart * fragments * together);
}

}  // namespace triptych::judge
