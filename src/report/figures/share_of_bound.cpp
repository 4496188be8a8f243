#include "report/figures/share_of_bound.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace triptych::report {
namespace {

using core::Image;

// Returns the largest error of a pixel as a share of its bound. `i` is the index of its first
// channel.
double share_at(const Image& image, const Image& truth, const Image& bound, std::size_t i) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const bool certain = !truth.ids.empty() && bound.ids[i / 4] == 0;
  if (certain && image.ids[i / 4] != truth.ids[i / 4]) return infinite;
  double share = 0;
  for (std::size_t c = 0; c < 4; ++c) {
    const double error = std::abs(static_cast<double>(image.rgba[i + c]) - truth.rgba[i + c]);
    if (!std::isfinite(error)) return infinite;
    share = error == 0 ? share : std::max(share, error / static_cast<double>(bound.rgba[i + c]));
  }
  return share;
}

// `largest` is the largest finite share of the image.
void paint(Image& shares, std::size_t i, double share, double largest) {
  const auto ramp = [&](double from, double to) {
    return static_cast<float>(std::clamp((share - from) / (to - from), 0.0, 1.0));
  };
  shares.rgba[i + 3] = 1;
  if (share > 1) {
    const double excess = share < largest ? std::log(share) / std::log(largest) : 1.0;
    shares.rgba[i] = 0;
    shares.rgba[i + 1] = static_cast<float>(0.2 + 0.8 * excess);
    shares.rgba[i + 2] = 1;
    return;
  }
  shares.rgba[i] = ramp(0.2, 0.7);
  shares.rgba[i + 1] = ramp(0.3, 1.0);
  shares.rgba[i + 2] = std::max(0.4F * ramp(0.0, 0.2), ramp(0.8, 1.0));
}

// A pixel whose error exceeds its bound.
struct WrongPixel {
  double share;
  ShareOfBound::Mark at;
};

std::vector<ShareOfBound::Mark> spread_out(std::vector<WrongPixel> beyond, int distance) {
  constexpr std::size_t max_marks = 12;
  std::ranges::stable_sort(beyond, std::greater{}, &WrongPixel::share);
  std::vector<ShareOfBound::Mark> marks;
  for (const WrongPixel& each : beyond) {
    const bool overlaps = std::ranges::any_of(marks, [&](const ShareOfBound::Mark& mark) {
      return std::hypot(mark.x - each.at.x, mark.y - each.at.y) < distance;
    });
    if (!overlaps) marks.push_back(each.at);
    if (marks.size() == max_marks) break;
  }
  return marks;
}

}  // namespace

ShareOfBound share_of_bound(const Image& image, const Image& truth, const Image& bound) {
  ShareOfBound result{.image = Image(image.width, image.height)};
  std::vector<double> shares;
  for (std::size_t i = 0; i < result.image.rgba.size(); i += 4) {
    shares.push_back(share_at(image, truth, bound, i));
    if (std::isfinite(shares.back())) {
      result.largest_finite = std::max(result.largest_finite, shares.back());
    }
  }
  double largest = 0;
  std::vector<WrongPixel> beyond;
  for (std::size_t i = 0; i < result.image.rgba.size(); i += 4) {
    const double share = shares[i / 4];
    paint(result.image, i, share, result.largest_finite);
    const int pixel = static_cast<int>(i / 4);
    if (share > 1) beyond.push_back({share, {pixel % image.width, pixel / image.width}});
    if (share <= largest) continue;
    largest = share;
    result.x = pixel % image.width;
    result.y = pixel / image.width;
  }
  result.ring_radius = std::max(3, std::max(image.width, image.height) / 24);
  result.marks = spread_out(std::move(beyond), 2 * result.ring_radius);
  return result;
}

}  // namespace triptych::report
