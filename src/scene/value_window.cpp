#include "scene/value_window.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "scene/scalar_dispatch.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene {
namespace {

[[noreturn]] void refuse(std::string_view text) {
  throw core::InputError(
      fmt::format("window '{}': expected full, or LOW..HIGH where each end is a number or a "
                  "percentile from p0 to p100, such as 0.5..3, p1..p99 or 0..p99.5",
                  quotable(text)));
}

std::optional<WindowEnd> parse_end(std::string_view text) {
  const bool percentile = text.starts_with('p');
  const auto number = parse_number<double>(percentile ? text.substr(1) : text);
  if (!number || !std::isfinite(*number)) return std::nullopt;
  if (percentile && (*number < 0 || *number > 100)) return std::nullopt;
  return WindowEnd{*number, percentile};
}

struct Range {
  double lo = 0;
  double hi = 0;
};

std::string text_of(const Range& range) {
  return fmt::format("{}..{}", range.lo, range.hi);
}

// The values of a volume that are used to determine ranges and percentiles. These are the finite
// values or, for a logarithmic mapping, the positive finite values.
template <typename Scalar>
class Counted {
 public:
  Counted(const Volume& volume, Mapping mapping) : volume_(volume), mapping_(mapping) {
    for_each([this](Scalar value) {
      range_.lo = std::min(range_.lo, static_cast<double>(value));
      range_.hi = std::max(range_.hi, static_cast<double>(value));
    });
  }

  [[nodiscard]] bool empty() const { return range_.lo > range_.hi; }
  [[nodiscard]] const Range& range() const { return range_; }

  // Returns a percentile by the nearest-rank method. The first call stores a copy of the values for
  // later calls.
  [[nodiscard]] double percentile(double percent) {
    if (values_.empty()) for_each([this](Scalar value) { values_.push_back(value); });
    const auto count = static_cast<double>(values_.size());
    const double rank = std::clamp(std::ceil(percent * count / 100), 1.0, count);
    const auto at = values_.begin() + (static_cast<std::ptrdiff_t>(rank) - 1);
    std::nth_element(values_.begin(), at, values_.end());
    return static_cast<double>(*at);
  }

 private:
  template <typename Use>
  void for_each(Use&& use) const {
    const std::size_t count = volume_.voxel_count();
    for (std::size_t i = 0; i < count; ++i) {
      const auto value = load_scalar<Scalar>(volume_.voxels.data(), i);
      const auto number = static_cast<double>(value);
      if (std::isfinite(number) && (mapping_ == Mapping::linear || number > 0)) use(value);
    }
  }

  const Volume& volume_;
  Mapping mapping_;
  Range range_{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  std::vector<Scalar> values_;
};

[[noreturn]] void refuse_values(const Volume& volume, Mapping mapping) {
  throw core::InputError(
      mapping == Mapping::logarithmic
          ? fmt::format("{}: mapping=log requires positive values, but no voxel has a positive "
                        "value",
                        volume.name)
          : fmt::format("{}: no voxel has a finite value, so there is no range to map",
                        volume.name));
}

template <typename Scalar>
Range range_of(const Window& window, Counted<Scalar>& counted, const std::string& name) {
  const auto end = [&](const WindowEnd& each) {
    return each.percentile ? counted.percentile(each.number) : each.number;
  };
  const Range range{end(window.lo), end(window.hi)};
  if (range.lo < range.hi) return range;
  throw core::InputError(
      fmt::format("{}: the window {} is empty (the range of the values is {}); choose percentiles "
                  "that are farther apart, or give the ends as numbers",
                  name, text_of(range), text_of(counted.range())));
}

// Returns the normalised value of `value` (see Mapping), clamped to [0, 1].
double normalised(double value, const Range& range, Mapping mapping) {
  const bool logarithmic = mapping == Mapping::logarithmic;
  const auto scale = [logarithmic](double v) { return logarithmic ? std::log(v) : v; };
  const double x = (scale(value) - scale(range.lo)) / (scale(range.hi) - scale(range.lo));
  return std::clamp(x, 0.0, 1.0);
}

// The numbers of voxels below, inside and above the window. For a logarithmic mapping, values that
// are not positive count as below the window. `other` counts values that are not finite.
struct WindowShares {
  std::uint64_t below = 0;
  std::uint64_t inside = 0;
  std::uint64_t above = 0;
  std::uint64_t other = 0;
};

template <typename Scalar>
WindowShares window_shares(const Volume& volume, const Range& range) {
  WindowShares shares;
  for (std::size_t i = 0; i < volume.voxel_count(); ++i) {
    const auto value = static_cast<double>(load_scalar<Scalar>(volume.voxels.data(), i));
    if (!std::isfinite(value)) {
      ++shares.other;
    } else if (value < range.lo) {
      ++shares.below;
    } else {
      ++(value > range.hi ? shares.above : shares.inside);
    }
  }
  return shares;
}

// Returns a note if nearly all values are on the same side of the window, so that the image shows
// hardly any of the data. Returns an empty string otherwise.
template <typename Scalar>
std::string window_note(const WindowShares& shares, const Range& range, Mapping mapping,
                        Counted<Scalar>& counted) {
  constexpr double nearly_all = 0.9999;
  const double finite = static_cast<double>(shares.below + shares.inside + shares.above);
  const bool is_below = shares.below > shares.above;
  const double share = static_cast<double>(is_below ? shares.below : shares.above) / finite;
  if (share < nearly_all) return {};
  std::string percentiles;
  for (const double percent : {1.0, 25.0, 50.0, 75.0, 99.0}) {
    percentiles += fmt::format(" p{} {:.6g}", percent, counted.percentile(percent));
  }
  return fmt::format(
      "{:.6g} % of the values are {} the window {}, so they are drawn like its {} end; the range "
      "of the {}values is {}, and their percentiles are{}",
      100 * share, is_below ? "below" : "above", text_of(range), is_below ? "lower" : "upper",
      mapping == Mapping::logarithmic ? "positive " : "", text_of(counted.range()), percentiles);
}

template <typename Scalar>
void set_window_of(Volume& volume, const std::optional<Window>& window, Mapping mapping) {
  Counted<Scalar> counted(volume, mapping);
  if (counted.empty()) refuse_values(volume, mapping);
  const Range available = counted.range();
  const Range range = window ? range_of(*window, counted, volume.name)
                             : Range{std::max(volume.range_lo, available.lo), volume.range_hi};
  if (mapping == Mapping::logarithmic && !(range.lo > 0)) {
    throw core::InputError(
        fmt::format("{}: mapping=log requires a window with a positive lower end, but it begins "
                    "at {} (the range of the positive values is {})",
                    volume.name, range.lo, text_of(available)));
  }
  volume.range_lo = range.lo;
  volume.range_hi = range.hi;
  volume.mapping = mapping;
  volume.clipped = available.lo < range.lo || available.hi > range.hi;
  const WindowShares shares = window_shares<Scalar>(volume, range);
  // For a logarithmic mapping, values that are not positive are normalised to 0.
  const double lowest =
      mapping == Mapping::logarithmic ? 0 : normalised(available.lo, range, mapping);
  const double highest = normalised(available.hi, range, mapping);
  // If the values have the type double, hi − lo may overflow. The results are then not numbers.
  if (shares.other == 0 && lowest <= highest) volume.used = {lowest, highest};
  if (std::string note = window_note(shares, range, mapping, counted); !note.empty()) {
    volume.facts.notes.push_back(std::move(note));
  }
}

}  // namespace

std::optional<Window> parse_window(std::string_view text) {
  if (text == "full") return std::nullopt;
  const std::size_t dots = text.find("..");
  if (dots == std::string_view::npos) refuse(text);
  const auto lo = parse_end(text.substr(0, dots));
  const auto hi = parse_end(text.substr(dots + 2));
  if (!lo || !hi) refuse(text);
  if (lo->percentile == hi->percentile && !(lo->number < hi->number)) {
    throw core::InputError(
        fmt::format("window '{}' is empty: its lower end is not below its upper end", text));
  }
  return Window{*lo, *hi};
}

Mapping mapping(std::string_view name) {
  for (const Mapping each : {Mapping::linear, Mapping::logarithmic}) {
    if (name == name_of(each)) return each;
  }
  throw core::InputError(fmt::format("mapping '{}': expected linear or log", name));
}

void set_window(Volume& volume, const std::optional<Window>& window, Mapping mapping) {
  if (!window && mapping == Mapping::linear) return;
  with_scalar_type(volume.type,
                   [&](auto zero) { set_window_of<decltype(zero)>(volume, window, mapping); });
}

}  // namespace triptych::scene
