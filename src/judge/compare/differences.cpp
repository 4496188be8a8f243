#include "judge/compare/differences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "judge/images/agreement.hpp"
#include "judge/images/image_metrics.hpp"

namespace triptych::judge {
namespace {

using Kind = DifferenceKind;

std::set<std::string> names_in(const record::Counts& a, const record::Counts& b) {
  std::set<std::string> names;
  for (const auto& [name, value] : a) names.insert(name);
  for (const auto& [name, value] : b) names.insert(name);
  return names;
}

std::optional<std::uint64_t> value_in(const record::Counts& counts, const std::string& name) {
  const auto found = counts.find(name);
  return found == counts.end() ? std::nullopt : std::optional(found->second);
}

// "1000 → 1001 (+0.1 %)"
std::string change(std::uint64_t a, std::uint64_t b) {
  const double before = static_cast<double>(a);
  std::string text = fmt::format("{} → {}", a, b);
  if (a > 0) text += fmt::format(" ({:+.4g} %)", 100 * (static_cast<double>(b) - before) / before);
  return text;
}

// Pixels with any channel, depth or id that differs, and where the colours differ most.
std::string describe_change(const core::Image& a, const core::Image& b) {
  core::Image no_bound(a.width, a.height);
  core::Image colours_a = a;
  core::Image colours_b = b;
  for (core::Image* image : {&colours_a, &colours_b}) {
    image->depth.clear();
    image->ids.clear();
  }
  const ImageComparison colours = compare(colours_b, colours_a, no_bound);
  std::string text = fmt::format("{} of {} pixels differ, most at ({}, {}) by {:.3g}, RMS {:.3g}",
                                 colours.over_bound, colours.pixels, colours.largest.x,
                                 colours.largest.y, colours.largest.error, colours.rmse);
  if (!a.ids.empty() && a.ids.size() == b.ids.size()) {
    std::size_t ids = 0;
    for (std::size_t i = 0; i < a.ids.size(); ++i) ids += a.ids[i] != b.ids[i] ? 1U : 0U;
    text += fmt::format("; {} show another particle", ids);
  }
  return text;
}

class Finder {
 public:
  Finder(const ComparedSide& a, const ComparedSide& b, bool same_setup)
      : a_(a),
        b_(b),
        same_setup_(same_setup),
        same_driver_(a.device.statistics_key() == b.device.statistics_key()) {}

  Comparison find() && {
    image();
    for (const std::string& name : names_in(a_.record.counters, b_.record.counters)) counter(name);
    for (const std::string& name : names_in(a_.record.statistics, b_.record.statistics)) {
      statistic(name);
    }
    std::ranges::stable_sort(result_.differences, {}, &Difference::kind);
    return std::move(result_);
  }

 private:
  void add(Kind kind, std::string about, std::string text) {
    result_.differences.push_back({kind, std::move(about), std::move(text)});
  }

  static std::string fault_of(const ComparedSide& side) {
    if (side.truth == nullptr) return {};
    return image_fault(compare(side.image, side.truth->truth, side.truth->bound), side.image,
                       side.truth->truth, "the truth");
  }

  void image() {
    if (a_.record.image.empty() && b_.record.image.empty()) return;
    if (a_.truth == nullptr || b_.truth == nullptr) {
      const ComparedSide& without = a_.truth == nullptr ? a_ : b_;
      add(Kind::unjudged, "image", "no truth to judge by: " + without.no_truth);
    }
    const std::string wrong_a = fault_of(a_);
    const std::string wrong_b = fault_of(b_);
    if (!wrong_b.empty()) {
      add(Kind::regression, "image",
          fmt::format("b: {}{}", wrong_b, wrong_a.empty() ? "" : "; a is wrong too: " + wrong_a));
    } else if (!wrong_a.empty()) {
      add(Kind::unjudged, "image", fmt::format("b is right, but a: {}", wrong_a));
    }
    if (!wrong_a.empty() || !wrong_b.empty()) {
      result_.void_time = fmt::format("the picture of {} is wrong, so its time means nothing",
                                      wrong_b.empty() ? "a" : "b");
    } else if (a_.record.image != b_.record.image) {
      other_bits();
    }
  }

  void other_bits() {
    const std::string what = describe_change(a_.image, b_.image);
    const bool same_code = a_.record.kernel_hash == b_.record.kernel_hash &&
                           a_.device.key() == b_.device.key() && same_setup_;
    if (same_code) {
      add(Kind::regression, "image",
          "other bits from the same device and the same device code: " + what);
    } else {
      add(Kind::expected, "image", "other bits: " + what);
    }
  }

  void counter(const std::string& name) {
    const auto a = value_in(a_.record.counters, name);
    const auto b = value_in(b_.record.counters, name);
    if (a == b) return;
    const std::string about = "counter " + name;
    if (!a || !b) {
      add(!b && same_driver_ ? Kind::regression : Kind::expected, about,
          fmt::format("only {} tells it: {}", a ? "a" : "b", a ? *a : *b));
      return;
    }
    const double reference = std::max(1.0, static_cast<double>(std::max(*a, *b)));
    const double relative = std::abs(static_cast<double>(*b) - static_cast<double>(*a)) / reference;
    if (same_driver_) {
      add(Kind::regression, about, change(*a, *b) + ", on the same driver");
    } else if (relative > counters_across_devices) {
      add(Kind::regression, about, change(*a, *b) + ", beyond what rounding decides");
    } else {
      add(Kind::expected, about, change(*a, *b) + ", where rounding decides");
    }
  }

  void statistic(const std::string& name) {
    const auto a = value_in(a_.record.statistics, name);
    const auto b = value_in(b_.record.statistics, name);
    if (a == b) return;
    const std::string about = "statistic " + name;
    if (!a || !b) {
      add(!b && same_driver_ ? Kind::regression : Kind::expected, about,
          fmt::format("only {} tells it: {}", a ? "a" : "b", a ? *a : *b));
      return;
    }
    const std::string on_a = statistic_reservation(a_.device.statistics_dialect, name);
    const std::string on_b = statistic_reservation(b_.device.statistics_dialect, name);
    const bool unsteady = on_a.starts_with("unsteady") || on_b.starts_with("unsteady");
    if (same_driver_ && !unsteady) {
      add(Kind::regression, about, change(*a, *b) + ", on the same driver");
    } else if (!on_a.empty() || !on_b.empty()) {
      add(Kind::dialect, about,
          fmt::format("{}; a: {}; b: {}", change(*a, *b), on_a.empty() ? "exact" : on_a,
                      on_b.empty() ? "exact" : on_b));
    } else if (std::ranges::find(portable_statistics, name) != portable_statistics.end()) {
      add(Kind::regression, about, change(*a, *b) + ", which drivers must agree on");
    } else {
      add(Kind::expected, about, change(*a, *b) + ", which the API leaves to the driver");
    }
  }

  const ComparedSide& a_;
  const ComparedSide& b_;
  bool same_setup_;
  bool same_driver_;
  Comparison result_;
};

}  // namespace

std::string_view name_of(DifferenceKind kind) {
  switch (kind) {
    case Kind::regression:
      return "regression";
    case Kind::unjudged:
      return "unjudged";
    case Kind::dialect:
      return "dialect";
    case Kind::expected:
      break;
  }
  return "expected";
}

Comparison find_differences(const ComparedSide& a, const ComparedSide& b, bool same_setup) {
  return Finder(a, b, same_setup).find();
}

}  // namespace triptych::judge
