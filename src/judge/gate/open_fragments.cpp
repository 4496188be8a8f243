#include "judge/gate/open_fragments.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "judge/baselines/frame_change.hpp"

namespace triptych::judge {
namespace {

// The number of sub-pixel bits to assume if the device does not report it. The accepted devices
// have eight bits, and so does Triptych's rasterizer for OpenCL.
constexpr double usual_bits = 8;

std::optional<double> precision_of(const record::Record& record, const char* name) {
  const auto found = record.precision.find(name);
  return found == record.precision.end() ? std::nullopt : std::optional(found->second);
}

bool is_open(const std::string& counter, const record::Record& record) {
  if (counter == "fragments" || counter == "fragments_discarded") return true;
  // The counters fragments_kept and visible_ids may differ only if rays are computed at the
  // vertices: when a driver snaps a vertex to its sub-pixel grid, it then also moves the ray of the
  // vertex. This moves the silhouettes of the spheres, and may change which surface is visible in a
  // pixel.
  const auto ray = record.factors.find("ray");
  return (counter == "fragments_kept" || counter == "visible_ids") && ray != record.factors.end() &&
         ray->second == "vertex";
}

}  // namespace

// Derivation of the number of fragments by which two correct drivers may differ:
//   - A driver snaps each vertex to its grid of 2⁻ᵇ pixel (b is its number of sub-pixel bits) by
//     rounding or truncation, so the vertex moves by less than one grid step. The other driver is
//     assumed to have a grid of 2⁻⁸ pixel. The positions of a sprite's edge in the two images
//     therefore differ by up to 2⁻ᵇ + 2⁻⁸ pixel, plus the amount by which the sprite is enlarged on
//     a coarse grid (technique/particles/margins.hpp). A point is enlarged by half its margin on
//     each side, and by up to the same amount again if the device rounds its size up. The sum of
//     all these amounts is δ.
//   - An edge of length L that moves by δ crosses δ·L pixel centres on average. The edges of S
//     sprites with F fragments have a total length of at most 4·√(S·F) (for squares, by the
//     Cauchy-Schwarz inequality; a polygon around the same disc has a shorter outline), and the
//     four corners of a sprite add δ² each.
//   - An edge that is parallel to an axis crosses either all of its L pixel centres or none. The
//     variance is δ·L² for one edge and 4·δ·F for all edges. If m sprites lie in the same place,
//     their edges cross together, which makes the variance m times as large; m is S divided by the
//     number of visible particles.
//   - The result is the mean plus five standard deviations.
double open_fragments(const std::string& counter, const record::Record& record) {
  constexpr double deviations = 5;
  if (!is_open(counter, record)) return 0;
  const double bits = precision_of(record, "sub_pixel_bits").value_or(usual_bits);
  const double enlargement = std::max(0.0, 2 * std::exp2(-bits) - 1.0 / 64) +
                             precision_of(record, "point_margin").value_or(0);
  const double displacement = std::exp2(-bits) + std::exp2(-usual_bits) + enlargement;
  const double fragments = count_of(record.counters, "fragments").value_or(0);
  const double sprites = count_of(record.counters, "sprites").value_or(0);
  const double visible = count_of(record.counters, "visible_ids").value_or(0);
  const double overlap = std::max(1.0, sprites / std::max(1.0, visible));
  return displacement * 4 * std::sqrt(sprites * fragments) +
         4 * displacement * displacement * sprites +
         deviations * std::sqrt(4 * displacement * fragments * overlap);
}

}  // namespace triptych::judge
