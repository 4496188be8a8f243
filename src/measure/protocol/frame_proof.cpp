#include "measure/protocol/frame_proof.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

#include "core/nan_pixel.hpp"
#include "measure/contract/not_drawn.hpp"

namespace triptych::measure {
namespace {

// Returns the number of pixels that differ. Compares bits, so that a NaN equals itself.
template <class Value>
std::size_t pixels_that_differ(const std::vector<Value>& one, const std::vector<Value>& other,
                               std::size_t per_pixel) {
  if (one.size() != other.size()) return std::max(one.size(), other.size()) / per_pixel;
  if (std::memcmp(one.data(), other.data(), one.size() * sizeof(Value)) == 0) return 0;
  std::size_t count = 0;
  for (std::size_t at = 0; at + per_pixel <= one.size(); at += per_pixel) {
    if (std::memcmp(&one[at], &other[at], per_pixel * sizeof(Value)) != 0) ++count;
  }
  return count;
}

std::size_t pixels_that_differ(const core::Image& one, const core::Image& other) {
  return std::max({pixels_that_differ(one.rgba, other.rgba, 4),
                   pixels_that_differ(one.depth, other.depth, 1),
                   pixels_that_differ(one.ids, other.ids, 1)});
}

template <class Predicate>
std::size_t count_pixels(const core::Image& image, const Predicate& counts) {
  std::size_t count = 0;
  for (std::size_t at = 0; at + 4 <= image.rgba.size(); at += 4) {
    if (counts(std::span<const float, 4>(&image.rgba[at], 4))) ++count;
  }
  return count;
}

}  // namespace

void FrameProof::start() {
  prepared_.poison();
  if (started_) return;
  started_ = true;
  const core::Image before = prepared_.image();
  const std::size_t unchanged = before.pixel_count() - count_pixels(before, core::is_nan_pixel);
  if (unchanged > 0) {
    throw NotDrawn(
        fmt::format("the image could not be overwritten before the first frame: {} of {} pixels "
                    "kept their values, although the driver reported the fill commands as finished",
                    unchanged, before.pixel_count()));
  }
  if (before.pixel_count() > 0)
    std::copy_n(before.rgba.begin(), fill_value_.size(), fill_value_.begin());
}

// Returns the number of pixels that still contain the fill value. A NaN that the device computed
// has different bits, so it does not count as the fill value.
std::size_t FrameProof::pixels_without_value(const core::Image& image) const {
  return count_pixels(image, [this](std::span<const float, 4> pixel) {
    return std::memcmp(pixel.data(), fill_value_.data(), sizeof fill_value_) == 0;
  });
}

void FrameProof::read(std::string_view what) {
  last_ = prepared_.image();
  without_value_ = pixels_without_value(last_);
  const std::size_t pixels = last_.pixel_count();
  if (!first_) {
    if (pixels > 0 && without_value_ == pixels) {
      throw NotDrawn(fmt::format("{} was not drawn: none of {} pixels was written", what, pixels));
    }
    first_ = last_;
    first_without_value_ = without_value_;
    return;
  }
  if (without_value_ > first_without_value_) {
    throw NotDrawn(
        fmt::format("{}: {} of {} pixels still contain the fill value that was written before the "
                    "frame, compared with {} pixels in the first frame",
                    what, without_value_, pixels, first_without_value_));
  }
}

const core::Image& FrameProof::check(std::string_view what) {
  read(what);
  if (std::exchange(renew_reference_, false)) first_ = last_;
  const std::size_t differing = pixels_that_differ(*first_, last_);
  if (differing > 0) {
    throw NotDrawn(
        fmt::format("{} differs from the first frame of the same scene in {} of {} pixels", what,
                    differing, last_.pixel_count()));
  }
  return last_;
}

void FrameProof::check_drawn(std::string_view what) {
  read(what);
}

void check_loop(const std::vector<double>& loop_wall_ns, std::vector<double> proven_wall_ns,
                const std::function<double()>& draw_checked) {
  constexpr double least_judged_ns = 2e6;
  constexpr double least_share = 0.1;
  constexpr std::size_t most_frames = 100;
  if (proven_wall_ns.empty() || loop_wall_ns.empty()) return;
  const double fastest = std::ranges::min(loop_wall_ns);
  double proven = std::ranges::min(proven_wall_ns);
  const auto is_explained = [&] {
    return proven < least_judged_ns || fastest >= least_share * proven;
  };
  while (!is_explained() && proven_wall_ns.size() < most_frames) {
    proven_wall_ns.push_back(draw_checked());
    proven = std::min(proven, proven_wall_ns.back());
  }
  if (is_explained()) return;
  throw NotDrawn(
      fmt::format("a frame of the wall-clock loop (frames drawn back to back) cannot have been "
                  "drawn, because it took only {:.3g} ms, but the fastest of the {} frames whose "
                  "images were checked took {:.3g} ms",
                  fastest * 1e-6, proven_wall_ns.size(), proven * 1e-6));
}

}  // namespace triptych::measure
