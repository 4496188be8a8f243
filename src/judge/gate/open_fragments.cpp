#include "judge/gate/open_fragments.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "judge/baselines/frame_change.hpp"

namespace triptych::judge {
namespace {

// The bits of sub-pixel precision if the API leaves the number open and the device does not report
// it. The accepted devices have eight, and so has Triptych's rasterizer for OpenCL.
constexpr double usual_bits = 8;

std::optional<double> told(const record::Record& record, const char* name) {
  const auto found = record.precision.find(name);
  return found == record.precision.end() ? std::nullopt : std::optional(found->second);
}

bool is_open(const std::string& counter, const record::Record& record) {
  if (counter == "fragments" || counter == "fragments_discarded") return true;
  // If rays are computed at the vertices, they move with the vertices, and so does the silhouette,
  // which determines the visible surface.
  const auto ray = record.factors.find("ray");
  return (counter == "fragments_kept" || counter == "visible_ids") && ray != record.factors.end() &&
         ray->second == "vertex";
}

}  // namespace

// The number of fragments by which two correct drivers may differ.
//   - A driver moves each vertex to its grid of 2⁻ᵇ pixel by rounding or truncation, that is by
//     less than one step. So an edge of a sprite lies up to 2⁻ᵇ + 2⁻⁸ pixel apart in the pictures
//     of two drivers, plus the amount by which the sprite is larger on a coarse grid
//     (technique/particles/margins.hpp). A point is larger by its margin, half of it on each side,
//     and by as much again where its size is rounded up. Together this is δ.
//   - An edge of length L that moves by δ passes δ·L centres of pixels on average. S sprites with F
//     fragments have edges of at most 4·√(S·F) together (for squares, by Cauchy and Schwarz; a
//     polygon around the same disc has less), and their four corners add δ² each.
//   - An edge along an axis passes all of its L centres or none. That is a variance of δ·L² for an
//     edge, and of 4·δ·F for all edges. m sprites in one place do it together, which makes the
//     variance m times as large; m is S over the number of visible particles.
//   - The result is the mean plus five standard deviations.
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
