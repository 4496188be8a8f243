#include "reference/preintegration_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "reference/extinction.hpp"

namespace triptych::reference {

namespace {

constexpr double last_bounded_entry = 255;
constexpr double infinity = std::numeric_limits<double>::infinity();
// The largest optical depth of a chunk, which consists of several cells (intervals between entries)
// that a device integrates at once. It determines how much light is lost because the series for the
// colour of a chunk is truncated after three coefficients.
constexpr double deepest_chunk = 0.5 * std::numbers::ln2;
constexpr double cut_off_of_chunk = 7.8e-5;
constexpr double least_left = 0x1.0p-20;

double cut_off(double depth) {
  return std::pow(depth, 4) / 635.0;
}

}  // namespace

double PreintegrationBound::Reach::bend() const {
  const double left = 1.0 - most_alpha;
  return left > 0.0 ? slope[3] * slope[3] / (8.0 * left * left) : infinity;
}

double PreintegrationBound::Reach::tail() const {
  const double left = 1.0 - most_alpha;
  const double r = left > 0.0 ? std::min(0.5 * slope[3] / left, 1.0) : 1.0;
  return std::min(std::pow(r, 14) / (210.0 * (1.0 - r * r)), 0.038);
}

PreintegrationBound::PreintegrationBound(const Table& table, const ErrorModel& model,
                                         const StepPath& path)
    : table_(table),
      model_(model),
      path_(path),
      span_(std::abs(path.to - path.from)),
      widening_(span_ > 4.0 * path.error ? 1.0 / (1.0 - 2.0 * path.error / span_) : 0.0),
      around_(reach(std::min(path.from, path.to) - path.error,
                    std::max(path.from, path.to) + path.error)),
      alpha_error_(path.error * around_.slope[3] + model.table_error) {
  lowest_ = highest_ = at(path.from);
}

PreintegrationBound::Rgba PreintegrationBound::at(double position) const {
  return table_.at(std::clamp(position, 0.0, last_bounded_entry));
}

PreintegrationBound::Reach PreintegrationBound::reach(double lo, double hi) const {
  const double first = std::clamp(std::floor(lo), 0.0, last_bounded_entry - 1);
  const double last = std::clamp(std::floor(hi), 0.0, last_bounded_entry - 1);
  Reach reach;
  for (double k = first; k <= last; k += 1.0) {
    const Rgba a = at(k);
    const Rgba b = at(k + 1);
    for (std::size_t i = 0; i < 4; ++i) {
      reach.slope[i] = std::max(reach.slope[i], std::abs(b[i] - a[i]));
    }
    const auto [low, high] = std::minmax(a[3], b[3]);
    reach.least_alpha = std::min(reach.least_alpha, low);
    reach.most_alpha = std::max(reach.most_alpha, high);
    const double most = extinction_of(high);
    const double least = extinction_of(low);
    if (high > low) {
      reach.tilt =
          std::max(reach.tilt, std::isfinite(most) ? (most - least) / (most + least) : 1.0);
    }
  }
  return reach;
}

// Returns the steepest slopes of the transfer function in the piece's cell (the interval between
// two entries) and in its two neighbours. These three cells are sufficient if the error of a
// position in the table is below one cell.
PreintegrationBound::Rgba PreintegrationBound::slopes_near(const PathPiece& piece) const {
  if (path_.error >= 1.0) return around_.slope;
  Rgba slopes{};
  const double cell = std::floor(piece.middle);
  for (const double k : {cell - 1.0, cell, cell + 1.0}) {
    const Rgba a = at(k);
    const Rgba b = at(k + 1.0);
    for (std::size_t i = 0; i < 4; ++i) slopes[i] = std::max(slopes[i], std::abs(b[i] - a[i]));
  }
  return slopes;
}

// Returns the largest relative change of the optical depth on the piece that the errors of opacity
// and length may cause. As a function of alpha, this change first falls and then rises, so it is
// largest at one of the ends of the piece.
double PreintegrationBound::relative_change(const PathPiece& piece, double alpha_error) const {
  double change = 0.0;
  for (const double alpha : {piece.a[3], piece.b[3]}) {
    const double nominal = depth_of(path_.length.nominal, extinction_of(alpha));
    const double lo =
        depth_of(path_.length.shortest, extinction_of(std::max(alpha - alpha_error, 0.0)));
    const double hi = depth_of(path_.length.longest, extinction_of(alpha + alpha_error));
    change = std::max({change, lo > 0.0 ? nominal / lo - 1.0 : infinity,
                       std::isfinite(hi) ? 1.0 - nominal / hi : 1.0});
  }
  return change;
}

void PreintegrationBound::add(const PathPiece& piece, double depth) {
  const bool first = added_ == 0;
  const bool last = added_ + 1 == path_.pieces;
  ++added_;
  for (std::size_t i = 0; i < 3; ++i) {
    lowest_[i] = std::min(lowest_[i], piece.b[i]);
    highest_[i] = std::max(highest_[i], piece.b[i]);
  }
  if (first || last) {
    const double position = first ? path_.from : path_.to;
    Reach end = reach(position - path_.error, position + path_.error);
    if (first && last) end = around_;
    if (widening_ > 0.0) {
      add_end(piece, position, end);
      add_deep_cell(piece, end.tilt);
    }
    add_weights(piece, depth, end.tail());
    return;
  }
  if (widening_ > 0.0) {
    const double most = extinction_of(std::max(piece.a[3], piece.b[3]) + model_.table_error);
    const double least = extinction_of(std::min(piece.a[3], piece.b[3]));
    const double tilt = std::isfinite(most) && most > 0.0 ? (most - least) / (most + least) : 1.0;
    add_deep_cell(piece, tilt);
  }
  add_weights(piece, depth, 0.0);
}

void PreintegrationBound::add_weights(const PathPiece& piece, double depth, double tail) {
  const Rgba slopes = slopes_near(piece);
  const double alpha_error = path_.error * slopes[3] + model_.table_error;
  // An opacity that is lowered below 0 is not clamped, because the result is still a lower bound.
  // If an opacity is raised above 1, it is 1 along a part of the piece, so the mean extinction is
  // infinite.
  const auto mean = [&](double by) {
    const double a = piece.a[3] + by;
    const double b = piece.b[3] + by;
    return std::max(a, b) < 1.0 ? mean_extinction(a, b) : infinity;
  };
  const StepLength& length = path_.length;
  const double least =
      depth_of(piece.length * length.shortest, std::max(mean(-alpha_error) - tail, 0.0));
  const double most = depth_of(piece.length * length.longest, mean(alpha_error) + tail);
  // `most` is infinite if the opacity may be 1 on a device. In that case, only the range of the
  // colour bounds the error of the light.
  const double change = std::isfinite(most) ? std::max(most - depth, depth - least) : most;
  const double relative = tail > model_.table_error
                              ? infinity
                              : relative_change(piece, alpha_error) + model_.opacity_error;
  const double opacity = opacity_of(most);
  if (front_ > 0.0) weights_ += front_ * std::min(change, relative * opacity);
  for (std::size_t i = 0; i < 3; ++i) {
    values_[i] += front_ * opacity * (path_.error * slopes[i] + model_.table_error);
  }

  least_ += least;
  most_ += most;
  depth_ += depth;
  tails_ += piece.length * tail;
  front_before_ = front_;
  if (widening_ == 0.0) return;
  // On a device, the first piece may be shorter, because the position of its front has an error. In
  // that case, the lower bound of its depth is its smallest extinction times its shortest length.
  const double thinnest =
      extinction_of(std::max(std::min(piece.a[3], piece.b[3]) - alpha_error, 0.0));
  const double certain =
      added_ > 1 ? least
                 : std::min(least, depth_of((piece.length - path_.error / span_) * length.shortest,
                                            thinnest));
  front_ *= std::exp(-certain / widening_);
}

// Adds the error of one cell (the interval between two entries), or of a part of a cell at an end
// of the step, if its depth exceeds the limit for chunks, which are several cells processed at
// once.
void PreintegrationBound::add_deep_cell(const PathPiece& piece, double tilt) {
  const double share = piece.length + 2.0 * path_.error / span_;
  const double extinction = mean_extinction(std::min(piece.a[3] + alpha_error_, 1.0),
                                            std::min(piece.b[3] + alpha_error_, 1.0));
  const double depth = depth_of(widening_ * share * path_.length.longest, extinction);
  if (depth < 0.999 * deepest_chunk) return;
  const double part = std::min(cut_off(depth), 0.25 * tilt * tilt * opacity_of(depth));
  for (std::size_t i = 0; i < 3; ++i) {
    const double value_error = path_.error * around_.slope[i] + model_.table_error;
    deep_cells_[i] += front_ * part * (std::abs(piece.b[i] - piece.a[i]) + 2.0 * value_error);
  }
}

// Adds the error at one end of the step. A device assumes that the extinction is linear within the
// part of a cell that the step covers there. On a device, the end may be in the neighbouring cell.
// In that case, this part is assumed to be as long as a whole cell, and the light that reaches it
// is the light in front of the previous piece.
void PreintegrationBound::add_end(const PathPiece& piece, double position, const Reach& end) {
  const double e = path_.error;
  const bool may_cross_entry = std::floor(position - e) != std::floor(position + e);
  const double share = path_.pieces == 1 ? 1.0
                       : may_cross_entry ? 1.0 / span_
                                         : piece.length + e / span_;
  const double length = widening_ * share * path_.length.longest;
  const double least = extinction_of(end.least_alpha);
  const double bend = end.bend();
  const double change = std::min(depth_of(length, bend), least > 0.0 ? bend / least : infinity);
  const double front = may_cross_entry ? front_before_ : front_;
  for (std::size_t i = 0; i < 3; ++i) {
    ends_[i] += front * end.slope[i] * std::min(2.0 * change, 1.0);
  }
}

// Because of the errors of values, a device may enter cells (intervals between entries) at either
// end of the step that the exact step does not enter. Returns whether the optical depth of these
// parts of cells may exceed the limit for a chunk (a group of cells that a device processes at
// once). If so, each of these parts adds an error as large as the range of its colour.
bool PreintegrationBound::deep_slivers() const {
  const double share = widening_ * 2.0 * path_.error / std::max(span_, 1e-300);
  const double extinction = extinction_of(around_.most_alpha + model_.table_error);
  return depth_of(share * path_.length.longest, extinction) > 0.999 * deepest_chunk;
}

double PreintegrationBound::extinction_around(double position) const {
  double sum = 0.0;
  double lo = position - path_.error;
  while (lo < position + path_.error) {
    const double hi = std::min(std::floor(lo) + 1.0, position + path_.error);
    sum += depth_of(hi - lo, mean_extinction(at(lo)[3], at(hi)[3]));
    lo = hi;
  }
  return sum;
}

// Returns the largest optical depth that the path may have on a device. If a raised opacity would
// be 1, the sum of the pieces is infinite. The depth is then computed from the exact depth instead:
// a device passes the same cells, and at each end it goes farther by at most its value error.
double PreintegrationBound::most_depth() const {
  if (std::isfinite(most_) || widening_ == 0.0) return most_;
  const double ends = (extinction_around(path_.from) + extinction_around(path_.to)) / span_;
  const double per_voxel = depth_ / path_.length.nominal + ends + tails_;
  return depth_of(widening_ * path_.length.longest, per_voxel);
}

StepOpacity PreintegrationBound::opacity(double nominal) const {
  const std::size_t beyond =
      path_.pieces > 3 && most_depth() > deepest_chunk ? path_.pieces - 3 : 0;
  const double relative =
      model_.opacity_error + static_cast<double>(beyond) * model_.compositing_error;
  return {.nominal = nominal,
          .lo = opacity_of(least_) * std::max(1.0 - relative, 0.0),
          .hi = std::min(opacity_of(most_depth()) * (1.0 + relative), 1.0)};
}

double PreintegrationBound::colour_error(std::size_t i, const StepOpacity& opacity) const {
  const double most = std::min(
      opacity.nominal + std::max(opacity.hi - opacity.nominal, opacity.nominal - opacity.lo), 1.0);
  const double value_error = path_.error * around_.slope[i] + model_.table_error;
  const double roundings = 8.0 + 2.0 * static_cast<double>(path_.pieces);
  double error = roundings * model_.compositing_error;
  if (!(most > 0.0)) return error + value_error;
  error += std::min(values_[i] / most, value_error);
  if (deep_slivers()) error += 2.0 * value_error;
  const double range = highest_[i] - lowest_[i] + 2.0 * value_error;
  const double weights = std::min(2.0 * range * weights_, range * most);
  if (widening_ == 0.0) {
    const double cells =
        around_.slope[i] * std::min(2.0 * depth_of(path_.length.longest, around_.bend()), most);
    const double cut_offs = range * std::min(cut_off(most_depth()), most);
    return error + std::min(weights + cut_offs + cells, range * most + cut_offs) / most;
  }
  const double chunks =
      range * std::min(cut_off(most_depth()), cut_off_of_chunk * most + least_left);
  const double cut_offs = std::min(chunks + deep_cells_[i], range * most);
  const double ends = std::min(ends_[i], 2.0 * around_.slope[i] * most);
  // Like the exact colour, a device's colour is a weighted mean of the colours along the path,
  // apart from the truncation. The error therefore exceeds the range of these colours only by the
  // error of the truncation.
  return error + std::min(weights + cut_offs + ends, range * most + cut_offs) / most;
}

}  // namespace triptych::reference
