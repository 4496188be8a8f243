#include "comparison/differences.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "accuracy/image_metrics.hpp"
#include "judge/agreement.hpp"
#include "judge/baselines/frame_change.hpp"
#include "judge/code/code_change.hpp"
#include "judge/gate/open_counts.hpp"
#include "judge/image_observation.hpp"
#include "report/words/finding.hpp"
#include "report/words/outcome.hpp"

namespace triptych::comparison {
namespace {

using Kind = DifferenceKind;

// The additional share of instructions that is allowed for a frame of another driver, or of the
// same driver with other settings. It is the same share by which a time must grow to be called
// slower.
constexpr double frame_across_setups = 0.01;
// The change from which preparation alone is reported, because it varies from run to run.
constexpr double of_preparing = 0.05;

template <typename Map>
std::set<std::string> names_in(const Map& a, const Map& b) {
  std::set<std::string> names;
  for (const auto& [name, value] : a) names.insert(name);
  for (const auto& [name, value] : b) names.insert(name);
  return names;
}

std::optional<std::uint64_t> value_in(const record::Counts& counts, const std::string& name) {
  const auto found = counts.find(name);
  return found == counts.end() ? std::nullopt : std::optional(found->second);
}

// Formats a change as "1000 → 1001 (+0.1 %)".
std::string change(std::uint64_t a, std::uint64_t b) {
  const double before = static_cast<double>(a);
  std::string text = fmt::format("{} → {}", a, b);
  if (a > 0) text += fmt::format(" ({:+.4g} %)", 100 * (static_cast<double>(b) - before) / before);
  return text;
}

std::optional<double> ratio_of(std::uint64_t a, std::uint64_t b) {
  if (a == 0 || b == 0) return std::nullopt;
  return static_cast<double>(b) / static_cast<double>(a);
}

// The number of pixels with any channel, depth or id that differs, and the place where the colours
// differ most.
std::string describe_change(const core::Image& a, const core::Image& b) {
  core::Image no_bound(a.width, a.height);
  core::Image colours_a = a;
  core::Image colours_b = b;
  for (core::Image* image : {&colours_a, &colours_b}) {
    image->depth.clear();
    image->ids.clear();
  }
  const accuracy::ImageComparison colours = accuracy::compare(colours_b, colours_a, no_bound);
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
        same_driver_(a.device.statistics_key() == b.device.statistics_key()),
        same_device_(a.device.key() == b.device.key()),
        same_id_(a.device.id == b.device.id),
        open_a_(a.record, a.open_counts),
        open_b_(b.record, b.open_counts) {}

  Comparison find() && {
    if (!both_measured()) return std::move(result_);
    image();
    cost();
    code();
    memory();
    for (const std::string& name : names_in(a_.record.counters, b_.record.counters)) counter(name);
    for (const std::string& name : names_in(a_.record.statistics, b_.record.statistics)) {
      statistic(name);
    }
    std::ranges::stable_sort(result_.differences, {}, &Difference::kind);
    return std::move(result_);
  }

 private:
  void add(Kind kind, std::string about, std::string text, std::optional<double> ratio = {}) {
    result_.differences.push_back({kind, std::move(about), std::move(text), ratio});
  }

  // The text for a side that did not measure the configuration.
  static std::string end_of(std::string_view name, const record::Record& record) {
    return fmt::format("{} {}", name, report::words::text_of(record.outcome, record.reason));
  }

  bool both_measured() {
    using record::Outcome;
    const Outcome a = a_.record.outcome;
    const Outcome b = b_.record.outcome;
    if (a == Outcome::measured && b == Outcome::measured) return true;
    result_.void_time = b == Outcome::measured ? end_of("a", a_.record) : end_of("b", b_.record);
    if (a == b && a == Outcome::skipped)
      return false;  // neither can draw it, which is not a difference
    if (b == Outcome::measured) {
      add(a == Outcome::skipped && !same_id_ ? Kind::changed : Kind::fixed, "outcome",
          end_of("a", a_.record));
    } else if (b != Outcome::skipped) {
      const bool new_fault = a == Outcome::measured || a == Outcome::skipped;
      add(new_fault ? Kind::regression : Kind::unjudged, "outcome",
          end_of("b", b_.record) + (new_fault ? "" : "; " + end_of("a", a_.record)));
    } else {
      add(same_id_ ? Kind::unjudged : Kind::changed, "outcome", end_of("b", b_.record));
    }
    return false;
  }

  // nullopt if the image is right, or if there is no reference image to compare it with.
  static std::optional<judge::Observation> fault_of(const ComparedSide& side) {
    if (side.truth == nullptr) return std::nullopt;
    judge::Observation what = judge::image_observation(
        accuracy::compare(side.image, side.truth->truth, side.truth->bound), side.image,
        side.truth->truth, judge::Against::reference);
    if (what.cause == judge::Cause::within_bound) return std::nullopt;
    return what;
  }

  void image() {
    if (a_.record.image.empty() && b_.record.image.empty()) return;
    if (a_.truth == nullptr || b_.truth == nullptr) {
      const ComparedSide& without = a_.truth == nullptr ? a_ : b_;
      add(Kind::unjudged, "image", "no truth to judge by: " + without.no_truth);
    }
    const auto wrong_a = fault_of(a_);
    const auto wrong_b = fault_of(b_);
    using report::words::text_of;
    if (wrong_b && wrong_a) {
      add(Kind::unjudged, "image",
          fmt::format("both are wrong, b: {}; a: {}", text_of(*wrong_b), text_of(*wrong_a)));
    } else if (wrong_b) {
      add(Kind::regression, "image", "b: " + text_of(*wrong_b));
    } else if (wrong_a) {
      add(b_.truth == nullptr ? Kind::unjudged : Kind::fixed, "image", "a: " + text_of(*wrong_a));
    }
    if (wrong_a || wrong_b) {
      result_.void_time =
          fmt::format("the image of {} is wrong, so its time means nothing", wrong_b ? "b" : "a");
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
      add(Kind::changed, "image", "other bits: " + what);
    }
  }

  // On one device, with either program, every instruction counts; otherwise the frame as a whole.
  void cost() {
    const record::Counts& before = a_.record.cost;
    const record::Counts& now = b_.record.cost;
    if (before.empty() || now.empty()) return;
    if (a_.record.counted_by != b_.record.counted_by) {
      return add(
          Kind::unjudged, "cost",
          fmt::format("a was counted by {}, b by {}", a_.record.counted_by, b_.record.counted_by));
    }
    const judge::FrameChange change = judge::frame_change(b_.record, before);
    const double frame = judge::frame_of(before);
    const double ratio = frame > 0 ? judge::frame_of(now) / frame : 1;
    const bool more = same_device_ ? change.more : same_id_ && ratio > 1 + frame_across_setups;
    std::string text;
    for (const judge::Change& each : change.changes) {
      text += (text.empty() ? "" : "; ") + report::words::text_of(each);
    }
    if (!text.empty()) add(more ? Kind::regression : Kind::changed, "cost", text, ratio);
    preparing();
  }

  void preparing() {
    const double before = judge::frame_of(a_.record.prepare_cost);
    const double now = judge::frame_of(b_.record.prepare_cost);
    if (before > 0 && std::abs(now / before - 1) > of_preparing) {
      add(Kind::changed, "cost of preparing",
          fmt::format("instructions {:.0f} → {:.0f}", before, now), now / before);
    }
  }

  // Worse code for the same family is a regression, also across driver versions. Two families may
  // differ.
  void code() {
    if (a_.record.code.empty() || b_.record.code.empty()) return;
    const judge::CodeComparison comparison = judge::compare_code(a_.record.code, b_.record.code);
    const std::string text = judge::code_change_text(comparison);
    if (text.empty()) return;
    const bool worse = comparison.direction() == judge::CodeDirection::worse;
    add(worse && same_id_ ? Kind::regression : Kind::changed, "code", text);
  }

  void memory() {
    double all_a = 0;
    double all_b = 0;
    bool more = false;
    std::vector<std::string> changes;
    for (const std::string& kind : names_in(a_.record.memory, b_.record.memory)) {
      const double before = judge::count_of(a_.record.memory, kind).value_or(0);
      const double now = judge::count_of(b_.record.memory, kind).value_or(0);
      all_a += before;
      all_b += now;
      more = more || now > before;
      if (now != before) changes.push_back(fmt::format("{} {} → {} bytes", kind, before, now));
    }
    if (changes.empty() || all_a == 0 || all_b == 0) return;
    add(more && same_id_ ? Kind::regression : Kind::changed, "memory",
        fmt::format("{}", fmt::join(changes, "; ")), all_b / all_a);
  }

  void counter(const std::string& name) {
    const auto a = value_in(a_.record.counters, name);
    const auto b = value_in(b_.record.counters, name);
    if (a == b) return;
    const std::string about = "counter " + name;
    if (!a || !b) {
      add(!b && same_driver_ ? Kind::regression : Kind::changed, about,
          fmt::format("only {} tells it: {}", a ? "a" : "b", a ? *a : *b));
      return;
    }
    const auto ratio = ratio_of(*a, *b);
    const double reference = std::max(1.0, static_cast<double>(std::max(*a, *b)));
    const double difference = std::abs(static_cast<double>(*b) - static_cast<double>(*a));
    const bool open = difference <= judge::counters_across_devices * reference ||
                      difference <= open_a_.of(name) || difference <= open_b_.of(name);
    if (same_driver_) {
      add(Kind::regression, about, change(*a, *b) + ", on the same driver", ratio);
    } else if (a_.device.api != b_.device.api && judge::is_of_the_api(name)) {
      add(Kind::changed, about, change(*a, *b) + ", which each API does in its own way", ratio);
    } else if (!open) {
      add(Kind::regression, about, change(*a, *b) + ", beyond what rounding decides", ratio);
    } else {
      add(Kind::changed, about, change(*a, *b) + ", where rounding decides", ratio);
    }
  }

  void statistic(const std::string& name) {
    const auto a = value_in(a_.record.statistics, name);
    const auto b = value_in(b_.record.statistics, name);
    if (a == b) return;
    const std::string about = "statistic " + name;
    if (!a || !b) {
      add(!b && same_driver_ ? Kind::regression : Kind::changed, about,
          fmt::format("only {} tells it: {}", a ? "a" : "b", a ? *a : *b));
      return;
    }
    const auto ratio = ratio_of(*a, *b);
    const auto on_a = judge::worth_of(a_.device.statistics_calibration, name);
    const auto on_b = judge::worth_of(b_.device.statistics_calibration, name);
    const bool unsteady = on_a.is_unsteady() || on_b.is_unsteady();
    if (same_driver_ && !unsteady) {
      add(Kind::regression, about, change(*a, *b) + ", on the same driver", ratio);
    } else if (!on_a.is_exact() || !on_b.is_exact()) {
      add(Kind::calibration, about,
          fmt::format("{}; a: {}; b: {}", change(*a, *b), report::words::text_of(on_a),
                      report::words::text_of(on_b)),
          ratio);
    } else if (std::ranges::find(judge::portable_statistics, name) !=
               judge::portable_statistics.end()) {
      add(Kind::regression, about, change(*a, *b) + ", which drivers must agree on", ratio);
    } else {
      add(Kind::changed, about, change(*a, *b) + ", which the API leaves to the driver", ratio);
    }
  }

  const ComparedSide& a_;
  const ComparedSide& b_;
  bool same_setup_;
  bool same_driver_;
  bool same_device_;
  bool same_id_;
  judge::OpenCounts open_a_;
  judge::OpenCounts open_b_;
  Comparison result_;
};

}  // namespace

std::string_view name_of(DifferenceKind kind) {
  switch (kind) {
    case Kind::regression:
      return "regression";
    case Kind::unjudged:
      return "cannot judge";
    case Kind::fixed:
      return "fixed";
    case Kind::calibration:
      return "calibration";
    case Kind::changed:
      break;
  }
  return "changed";
}

namespace {

std::string text_of(const std::string& limit) {
  return limit;
}
std::string text_of(const record::StatisticWorth& worth) {
  return report::words::text_of(worth);
}

}  // namespace

std::vector<Difference> find_differences(const record::Device& a, const record::Device& b) {
  std::vector<Difference> differences;
  if (a.id != b.id) return differences;
  const auto look = [&](Kind kind, const char* what, const auto& of_a, const auto& of_b) {
    for (const std::string& name : names_in(of_a, of_b)) {
      const auto before = of_a.find(name);
      const auto now = of_b.find(name);
      const std::string about = fmt::format("{} {}", what, name);
      const bool both = before != of_a.end() && now != of_b.end();
      // A run calibrates only what its techniques need, so a calibration that one run lacks was not
      // examined.
      if (kind == Kind::calibration && !both) continue;
      if (before == of_a.end()) {
        differences.push_back({kind, about, "new: " + text_of(now->second)});
      } else if (now == of_b.end()) {
        differences.push_back({kind, about, "gone, was " + text_of(before->second)});
      } else if (before->second != now->second) {
        differences.push_back(
            {kind, about, fmt::format("{} → {}", text_of(before->second), text_of(now->second))});
      }
    }
  };
  look(Kind::changed, "limit", a.limits, b.limits);
  look(Kind::calibration, "statistic", a.statistics_calibration, b.statistics_calibration);
  return differences;
}

Comparison find_differences(const ComparedSide& a, const ComparedSide& b, bool same_setup) {
  return Finder(a, b, same_setup).find();
}

}  // namespace triptych::comparison
