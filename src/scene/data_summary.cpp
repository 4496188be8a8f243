#include "scene/data_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "scene/scalar_dispatch.hpp"

namespace triptych::scene {
namespace {

// An ASCII-art image whose characters range from blank to dense. A character cell is about twice as
// high as it is wide.
class TextImage {
 public:
  // The image has at most `most_columns` columns and `most_rows` rows. For a volume, the caller
  // passes the numbers of voxels along x and y, so that every character cell contains at least one
  // voxel.
  TextImage(double width, double height, std::size_t most_columns, std::size_t most_rows) {
    constexpr double longest = 56;
    const double scale = longest / std::max({width, height, std::numeric_limits<double>::min()});
    columns_ = std::clamp(static_cast<std::size_t>(std::lround(width * scale)), std::size_t{1},
                          std::min(most_columns, std::size_t{56}));
    rows_ = std::clamp(static_cast<std::size_t>(std::lround(height * scale / 2)), std::size_t{1},
                       std::min(most_rows, std::size_t{28}));
    cells_.assign(columns_ * rows_, 0);
  }

  // Returns the cell at a position in the image. The position is given as fractions of the image's
  // width and height, with y up.
  [[nodiscard]] double& at(double x, double y) {
    const auto place = [](double share, std::size_t count) {
      const double cell = std::clamp(share, 0.0, 1.0) * static_cast<double>(count);
      return std::min(static_cast<std::size_t>(cell), count - 1);
    };
    return cells_[(rows_ - 1 - place(y, rows_)) * columns_ + place(x, columns_)];
  }

  void append_to(std::vector<std::string>& lines) const {
    constexpr std::string_view letters = " .:-=+*#%@";
    const double most = *std::ranges::max_element(cells_);
    for (std::size_t row = 0; row < rows_; ++row) {
      std::string line = "    ";
      for (std::size_t column = 0; column < columns_; ++column) {
        const double share = most > 0 ? cells_[row * columns_ + column] / most : 0;
        line += letters[static_cast<std::size_t>(std::lround(share * 9))];
      }
      line.erase(line.find_last_not_of(' ') + 1);
      lines.push_back(std::move(line));
    }
  }

 private:
  std::size_t columns_ = 1;
  std::size_t rows_ = 1;
  std::vector<double> cells_;
};

void add_notes(std::vector<std::string>& lines, const ReadFacts& facts) {
  for (const std::string& note : facts.notes) lines.push_back("note: " + note);
}

// Returns a description of the frames of a trajectory, or an empty string if the file has one
// frame.
std::string frames_text(const ReadFacts& facts) {
  if (!facts.frames) {
    return fmt::format("frame: {} (the number of frames in the file is not known)", facts.frame);
  }
  if (*facts.frames == 1) return {};
  return fmt::format("frames: {} (0 to {}; this is frame {}; data=FILE@K selects frame K)",
                     *facts.frames, *facts.frames - 1, facts.frame);
}

// Returns the lengths of the box's edges and, if the edges are not orthogonal, the angles between
// them.
std::string box_text(const BoxEdges& edges) {
  const auto dot = [](const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  std::array<double, 3> lengths{};
  for (std::size_t i = 0; i < 3; ++i) lengths.at(i) = std::sqrt(dot(edges.at(i), edges.at(i)));
  std::string text = fmt::format("{:.6g} x {:.6g} x {:.6g}", lengths[0], lengths[1], lengths[2]);
  const std::array<double, 3> products{dot(edges[1], edges[2]), dot(edges[0], edges[2]),
                                       dot(edges[0], edges[1])};
  if (products == std::array<double, 3>{}) return text;
  const auto angle = [&](std::size_t i) {
    const double cosine = products.at(i) / (lengths.at((i + 1) % 3) * lengths.at((i + 2) % 3));
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
  };
  return text +
         fmt::format(", angles {:.6g}, {:.6g} and {:.6g} degrees", angle(0), angle(1), angle(2));
}

// Returns the smallest and the largest radius, or one number if they have the same six digits.
std::string radii_text(float least, float most, const std::string& unit) {
  const std::string smallest = fmt::format("{:.6g}", least);
  const std::string largest = fmt::format("{:.6g}", most);
  return smallest == largest ? fmt::format("{}{}, all equal", smallest, unit)
                             : fmt::format("{} to {}{}", smallest, largest, unit);
}

std::string unit_text(const ReadFacts& facts) {
  if (facts.format.empty()) return {};  // generated data have no unit
  return facts.unit.empty() ? " (the file does not specify a unit)" : " " + facts.unit;
}

// A histogram with bins of equal width. It is exact for integers whose range is at most 65535.
// Otherwise a bin is 1/65535 of the range wide.
struct Histogram {
  double step = 0;
  std::vector<std::uint64_t> counts = std::vector<std::uint64_t>(65536);
  std::uint64_t finite = 0;
  std::uint64_t other = 0;
};

Histogram histogram_of(const Volume& volume) {
  Histogram histogram;
  const double lo = volume.range_lo;
  const double range = volume.range_hi - lo;
  const bool floats = volume.type == ScalarType::f32 || volume.type == ScalarType::f64;
  histogram.step = !floats && range <= 65535 ? 1 : range / 65535;
  const double steps = histogram.step > 0 ? 1 / histogram.step : 0;
  with_scalar_type(volume.type, [&](auto zero) {
    using Scalar = decltype(zero);
    for (std::size_t i = 0; i < volume.voxel_count(); ++i) {
      const auto value = static_cast<double>(load_scalar<Scalar>(volume.voxels.data(), i));
      if (!std::isfinite(value)) {
        ++histogram.other;
        continue;
      }
      ++histogram.finite;
      const double step = std::clamp(std::round((value - lo) * steps), 0.0, 65535.0);
      ++histogram.counts[static_cast<std::size_t>(step)];
    }
  });
  return histogram;
}

double percentile_of(const Histogram& histogram, const Volume& volume, double percent) {
  const double rank =
      std::max(std::ceil(percent / 100 * static_cast<double>(histogram.finite)), 1.0);
  std::uint64_t below = 0;
  std::size_t step = 0;
  for (; step + 1 < histogram.counts.size(); ++step) {
    below += histogram.counts[step];
    if (static_cast<double>(below) >= rank) break;
  }
  return volume.range_lo + histogram.step * static_cast<double>(step);
}

void append_text_image(std::vector<std::string>& lines, const Volume& volume) {
  const auto [nx, ny, nz] = volume.size;
  TextImage text_image(nx * volume.spacing[0], ny * volume.spacing[1], static_cast<std::size_t>(nx),
                       static_cast<std::size_t>(ny));
  const double range = volume.range_hi - volume.range_lo;
  if (!(range > 0)) return;
  with_scalar_type(volume.type, [&](auto zero) {
    using Scalar = decltype(zero);
    std::size_t index = 0;
    for (int k = 0; k < nz; ++k) {
      for (int j = 0; j < ny; ++j) {
        for (int i = 0; i < nx; ++i, ++index) {
          const auto value = static_cast<double>(load_scalar<Scalar>(volume.voxels.data(), index));
          if (!std::isfinite(value)) continue;
          double& cell = text_image.at((i + 0.5) / nx, (j + 0.5) / ny);
          cell = std::max(cell, (value - volume.range_lo) / range);
        }
      }
    }
  });
  lines.emplace_back("preview of the maximum value along z (x points right, y points up):");
  text_image.append_to(lines);
}

void append_text_image(std::vector<std::string>& lines, const ParticleSet& set, const Box& box) {
  TextImage text_image(box.hi.x - box.lo.x, box.hi.y - box.lo.y, 56, 28);
  for (const auto& sphere : set.spheres) {
    const auto share = [](double at, double lo, double hi) {
      return hi > lo ? (at - lo) / (hi - lo) : 0.5;
    };
    text_image.at(share(sphere[0], box.lo.x, box.hi.x), share(sphere[1], box.lo.y, box.hi.y)) += 1;
  }
  lines.emplace_back(
      "preview of the number of particle centres along z (x points right, y "
      "points up):");
  text_image.append_to(lines);
}

}  // namespace

std::vector<std::string> summary_of(const Volume& volume) {
  const ReadFacts& facts = volume.facts;
  const auto [nx, ny, nz] = volume.size;
  const auto [sx, sy, sz] = volume.spacing;
  const Histogram histogram = histogram_of(volume);
  const std::string unit = unit_text(facts);
  std::vector<std::string> lines;
  lines.push_back(fmt::format("data: {}", volume.name));
  lines.push_back(fmt::format("format: {}", facts.format.empty() ? "generated" : facts.format));
  lines.push_back(fmt::format(
      "voxels: {} x {} x {}, {} of type {} each, stored as {}", nx, ny, nz,
      facts.components == 1 ? "one value" : fmt::format("{} values", facts.components),
      facts.value_type.empty() ? name_of(volume.type) : facts.value_type, name_of(volume.type)));
  lines.push_back(fmt::format("spacing: {:.6g} x {:.6g} x {:.6g}{}", sx, sy, sz, unit));
  lines.push_back(
      fmt::format("extent: {:.6g} x {:.6g} x {:.6g}{}", nx * sx, ny * sy, nz * sz, unit));
  lines.push_back(fmt::format("orientation: {}",
                              facts.orientation.empty()
                                  ? "not specified"
                                  : facts.orientation + " (directions of the axes x, y and z)"));
  lines.push_back(fmt::format(
      "range: {:.9g} to {:.9g}{}", volume.range_lo, volume.range_hi,
      histogram.other == 0 ? "" : fmt::format(", plus {} non-finite values", histogram.other)));
  std::string percentiles = "percentiles:";
  for (const double percent : {1.0, 25.0, 50.0, 75.0, 99.0}) {
    percentiles += fmt::format(" p{} {:.6g}", percent, percentile_of(histogram, volume, percent));
  }
  lines.push_back(percentiles);
  append_text_image(lines, volume);
  add_notes(lines, facts);
  return lines;
}

std::vector<std::string> summary_of(const ParticleSet& set) {
  const ReadFacts& facts = set.facts;
  const std::string unit = unit_text(facts);
  const Box box = bounding_box(set);
  std::vector<std::string> lines;
  lines.push_back(fmt::format("data: {}", set.name));
  lines.push_back(fmt::format("format: {}", facts.format.empty() ? "generated" : facts.format));
  lines.push_back(fmt::format(
      "particles: {}{}", set.count(),
      set.dropped == 0 ? ""
                       : fmt::format(", plus {} dropped because of an invalid position or radius",
                                     set.dropped)));
  if (const std::string frames = facts.format.empty() ? "" : frames_text(facts); !frames.empty()) {
    lines.push_back(frames);
  }
  if (!facts.kinds.empty()) {
    std::string kinds = facts.elements ? "elements:" : "types:";
    for (const auto& [name, count] : facts.kinds) kinds += fmt::format(" {} {}", name, count);
    lines.push_back(kinds);
  }
  lines.push_back(
      fmt::format("extent: ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}){}, including the "
                  "radii",
                  box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z, unit));
  if (facts.box_edges) {
    lines.push_back(fmt::format("simulation box: {}{}", box_text(*facts.box_edges), unit));
  }
  if (!set.spheres.empty()) {
    const auto [least, most] = std::ranges::minmax(
        set.spheres, {}, [](const std::array<float, 4>& sphere) { return sphere[3]; });
    lines.push_back("radii: " + radii_text(least[3], most[3], unit));
  }
  append_text_image(lines, set, box);
  add_notes(lines, facts);
  return lines;
}

}  // namespace triptych::scene
