#include "comparison/differences.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "accuracy/image_metrics.hpp"
#include "judge/agreement.hpp"
#include "judge/baselines/frame_change.hpp"
#include "judge/gate/open_counts.hpp"
#include "judge/image_observation.hpp"

namespace triptych::comparison {
namespace {

using Kind = DifferenceKind;
using Cause = DifferenceCause;
using measure::Side;

// The tolerated relative increase in the number of instructions per frame if both sides use the
// same device, but with different driver versions or settings. It equals the tolerated increase in
// time (SequentialDesign::standard()).
constexpr double frame_cost_tolerance = 0.01;
// Changes in the preparation cost (the instructions that are executed before the first frame) are
// reported only if they exceed this relative limit, because that cost varies from run to run.
constexpr double preparation_tolerance = 0.05;

template <typename Map>
std::set<std::string> all_names(const Map& a, const Map& b) {
  std::set<std::string> names;
  for (const auto& [name, value] : a) names.insert(name);
  for (const auto& [name, value] : b) names.insert(name);
  return names;
}

std::optional<std::uint64_t> value_in(const record::Counts& counts, const std::string& name) {
  const auto found = counts.find(name);
  return found == counts.end() ? std::nullopt : std::optional(found->second);
}

// Returns the number of pixels that differ between two images, and the pixel with the largest
// difference.
std::map<std::string, double> image_change(const core::Image& a, const core::Image& b) {
  core::Image no_bound(a.width, a.height);
  core::Image colours_a = a;
  core::Image colours_b = b;
  for (core::Image* image : {&colours_a, &colours_b}) {
    image->depth.clear();
    image->ids.clear();
  }
  const accuracy::ImageComparison colours = accuracy::compare(colours_b, colours_a, no_bound);
  std::map<std::string, double> numbers{{"pixels", static_cast<double>(colours.over_bound)},
                                        {"total", static_cast<double>(colours.pixels)},
                                        {"x", colours.largest.x},
                                        {"y", colours.largest.y},
                                        {"error", colours.largest.error},
                                        {"rmse", colours.rmse}};
  if (!a.ids.empty() && a.ids.size() == b.ids.size()) {
    std::size_t ids = 0;
    for (std::size_t i = 0; i < a.ids.size(); ++i) ids += a.ids[i] != b.ids[i] ? 1U : 0U;
    numbers["particles"] = static_cast<double>(ids);
  }
  return numbers;
}

// Returns the values of a counter or statistic on both sides. A missing value does not count as
// zero.
judge::Change change_of(const std::string& name, std::optional<std::uint64_t> a,
                        std::optional<std::uint64_t> b) {
  judge::Change change{.name = name};
  if (a) change.before = static_cast<double>(*a);
  if (b) change.now = static_cast<double>(*b);
  return change;
}

class DifferenceFinder {
 public:
  DifferenceFinder(const ComparedSide& a, const ComparedSide& b, bool same_setup)
      : a_(a),
        b_(b),
        same_setup_(same_setup),
        same_driver_(a.device.statistics_key() == b.device.statistics_key()),
        same_device_(a.device.key() == b.device.key()),
        same_id_(a.device.id == b.device.id),
        open_counts_a_(a.record, a.open_counts),
        open_counts_b_(b.record, b.open_counts) {}

  Comparison find() && {
    if (!check_outcomes()) return std::move(result_);
    compare_image();
    compare_cost();
    compare_code();
    compare_memory();
    for (const std::string& name : all_names(a_.record.counters, b_.record.counters))
      compare_counter(name);
    for (const std::string& name : all_names(a_.record.statistics, b_.record.statistics)) {
      compare_statistic(name);
    }
    std::ranges::stable_sort(result_.differences, {}, &Difference::kind);
    return std::move(result_);
  }

 private:
  Difference& add(Kind kind, Subject subject, Cause cause) {
    result_.differences.push_back({.kind = kind, .subject = subject, .cause = cause});
    return result_.differences.back();
  }

  // Returns the outcome of a side, or nullopt if the side measured the configuration.
  static std::optional<judge::Observation> outcome_observation(const record::Record& record) {
    if (record.outcome == record::Outcome::measured) return std::nullopt;
    return judge::Observation{
        .cause = judge::Cause::ended, .outcome = record.outcome, .reason = record.reason};
  }

  bool check_outcomes() {
    using record::Outcome;
    const Outcome a = a_.record.outcome;
    const Outcome b = b_.record.outcome;
    if (a == Outcome::measured && b == Outcome::measured) return true;
    const bool b_failed = b != Outcome::measured;
    const record::Record& ended = b_failed ? b_.record : a_.record;
    result_.no_time = {.cause = TimeCause::side_ended,
                       .side = b_failed ? Side::b : Side::a,
                       .outcome = ended.outcome,
                       .reason = ended.reason};
    // If neither side supports the configuration, there is no difference.
    if (a == b && a == Outcome::skipped) return false;
    Difference& found = add(outcome_kind(a, b), Subject::outcome, Cause::ended);
    if (!b_failed || found.kind == Kind::unjudged) found.sides[0] = outcome_observation(a_.record);
    found.sides[1] = outcome_observation(b_.record);
    return false;
  }

  [[nodiscard]] Kind outcome_kind(record::Outcome a, record::Outcome b) const {
    using record::Outcome;
    if (b == Outcome::measured) {
      return a == Outcome::skipped && !same_id_ ? Kind::changed : Kind::fixed;
    }
    if (b == Outcome::skipped) return same_id_ ? Kind::unjudged : Kind::changed;
    const bool new_fault = a == Outcome::measured || a == Outcome::skipped;
    return new_fault ? Kind::regression : Kind::unjudged;
  }

  // Returns the fault in a side's image. Returns nullopt if the image is correct or if there is no
  // reference image.
  static std::optional<judge::Observation> fault_of(const ComparedSide& side) {
    if (side.truth == nullptr) return std::nullopt;
    judge::Observation what = judge::image_observation(
        accuracy::compare(side.image, side.truth->truth, side.truth->bound), side.image,
        side.truth->truth, judge::Against::reference);
    if (what.cause == judge::Cause::within_bound) return std::nullopt;
    return what;
  }

  static std::optional<judge::Observation> no_reference(const ComparedSide& side) {
    if (side.truth != nullptr) return std::nullopt;
    return judge::Observation{.cause = judge::Cause::no_reference, .detail = side.no_truth};
  }

  void compare_image() {
    if (a_.record.image.empty() && b_.record.image.empty()) return;
    if (a_.truth == nullptr || b_.truth == nullptr) {
      add(Kind::unjudged, Subject::image, Cause::no_reference).sides = {no_reference(a_),
                                                                        no_reference(b_)};
    }
    BySide<judge::Observation> wrong{fault_of(a_), fault_of(b_)};
    const bool wrong_a = wrong[0].has_value();
    const bool wrong_b = wrong[1].has_value();
    if (!wrong_a && !wrong_b) {
      if (a_.record.image != b_.record.image) add_bit_difference();
      return;
    }
    const bool cannot_judge = wrong_a && (wrong_b || b_.truth == nullptr);
    const Kind kind_if_one_wrong = wrong_b ? Kind::regression : Kind::fixed;
    add(cannot_judge ? Kind::unjudged : kind_if_one_wrong, Subject::image, Cause::wrong_image)
        .sides = std::move(wrong);
    result_.no_time = {.cause = TimeCause::wrong_image, .side = wrong_b ? Side::b : Side::a};
  }

  void add_bit_difference() {
    const bool same_code = a_.record.kernel_hash == b_.record.kernel_hash &&
                           a_.device.key() == b_.device.key() && same_setup_;
    add(same_code ? Kind::regression : Kind::changed, Subject::image,
        same_code ? Cause::other_bits_of_one_code : Cause::other_bits)
        .numbers = image_change(a_.image, b_.image);
  }

  // Compares the numbers of instructions that one frame executes. If both sides have the same
  // device key (driver version and settings), the counts of device code and driver must each stay
  // within a small tolerance, even if the sides run different builds of Triptych. If only their
  // device ids are equal, only the sum of these counts is limited: it may grow by
  // frame_cost_tolerance.
  void compare_cost() {
    const record::Counts& before = a_.record.cost;
    const record::Counts& now = b_.record.cost;
    if (before.empty() || now.empty()) return;
    if (a_.record.counted_by != b_.record.counted_by) {
      add(Kind::unjudged, Subject::cost, Cause::two_counters).facts = {{"a", a_.record.counted_by},
                                                                       {"b", b_.record.counted_by}};
      return;
    }
    judge::FrameChange change = judge::frame_change(b_.record, before);
    const double frame = judge::frame_instructions(before);
    const double ratio = frame > 0 ? judge::frame_instructions(now) / frame : 1;
    const bool more =
        same_device_ ? change.increased : same_id_ && ratio > 1 + frame_cost_tolerance;
    if (!change.changes.empty()) {
      Difference& found =
          add(more ? Kind::regression : Kind::changed, Subject::cost, Cause::values_changed);
      found.changes = std::move(change.changes);
      found.ratio = ratio;
    }
    compare_preparation_cost();
  }

  void compare_preparation_cost() {
    const double before = judge::frame_instructions(a_.record.prepare_cost);
    const double now = judge::frame_instructions(b_.record.prepare_cost);
    if (before <= 0 || std::abs(now / before - 1) <= preparation_tolerance) return;
    Difference& found = add(Kind::changed, Subject::preparing, Cause::values_changed);
    found.changes = {
        {.name = "driver", .unit = judge::Unit::instructions, .before = before, .now = now}};
    found.ratio = now / before;
  }

  // Compares the reports of the compilers. If both sides have the same device id, worse code is a
  // regression, even across driver versions. For two different devices, the code may differ.
  void compare_code() {
    if (a_.record.code.empty() || b_.record.code.empty()) return;
    judge::CodeComparison comparison = judge::compare_code(a_.record.code, b_.record.code);
    if (comparison.changes.empty() && comparison.removed.empty() && comparison.added.empty())
      return;
    const bool worse = comparison.direction() == judge::CodeDirection::worse;
    add(worse && same_id_ ? Kind::regression : Kind::changed, Subject::code, Cause::code_changed)
        .code = std::move(comparison);
  }

  void compare_memory() {
    double total_a = 0;
    double total_b = 0;
    bool more = false;
    std::vector<judge::Change> changes;
    for (const std::string& kind : all_names(a_.record.memory, b_.record.memory)) {
      const double before = judge::count_of(a_.record.memory, kind).value_or(0);
      const double now = judge::count_of(b_.record.memory, kind).value_or(0);
      total_a += before;
      total_b += now;
      more = more || now > before;
      if (now == before) continue;
      changes.push_back({.name = kind, .unit = judge::Unit::bytes, .before = before, .now = now});
    }
    if (changes.empty() || total_a == 0 || total_b == 0) return;
    Difference& found = add(more && same_id_ ? Kind::regression : Kind::changed, Subject::memory,
                            Cause::values_changed);
    found.changes = std::move(changes);
    found.ratio = total_b / total_a;
  }

  // Adds a counter or statistic that only one side reports.
  void add_one_sided(Subject subject, const judge::Change& change) {
    const bool lost = !change.now && same_driver_;
    Difference& found =
        add(lost ? Kind::regression : Kind::changed, subject, Cause::reported_by_one_side);
    found.name = change.name;
    found.side = change.now ? Side::b : Side::a;
    found.changes = {change};
  }

  Difference& add_change(Kind kind, Subject subject, Cause cause, const judge::Change& change) {
    Difference& found = add(kind, subject, cause);
    found.name = change.name;
    found.changes = {change};
    if (*change.before > 0 && *change.now > 0) found.ratio = *change.now / *change.before;
    return found;
  }

  void compare_counter(const std::string& name) {
    const auto a = value_in(a_.record.counters, name);
    const auto b = value_in(b_.record.counters, name);
    if (a == b) return;
    const judge::Change change = change_of(name, a, b);
    if (!a || !b) return add_one_sided(Subject::counter, change);
    const double reference = std::max({1.0, *change.before, *change.now});
    const double difference = std::abs(*change.now - *change.before);
    const bool open = difference <= judge::counters_across_devices * reference ||
                      difference <= open_counts_a_.of(name) ||
                      difference <= open_counts_b_.of(name);
    if (same_driver_) {
      add_change(Kind::regression, Subject::counter, Cause::same_driver, change);
    } else if (a_.device.api != b_.device.api && judge::depends_on_api(name)) {
      add_change(Kind::changed, Subject::counter, Cause::api_specific, change);
    } else if (!open) {
      add_change(Kind::regression, Subject::counter, Cause::beyond_rounding, change);
    } else {
      add_change(Kind::changed, Subject::counter, Cause::within_rounding, change);
    }
  }

  void compare_statistic(const std::string& name) {
    const auto a = value_in(a_.record.statistics, name);
    const auto b = value_in(b_.record.statistics, name);
    if (a == b) return;
    const judge::Change change = change_of(name, a, b);
    if (!a || !b) return add_one_sided(Subject::statistic, change);
    const auto on_a = judge::worth_of(a_.device.statistics_calibration, name);
    const auto on_b = judge::worth_of(b_.device.statistics_calibration, name);
    const bool unsteady = on_a.is_unsteady() || on_b.is_unsteady();
    const bool agreed =
        std::ranges::find(judge::portable_statistics, name) != judge::portable_statistics.end();
    if (same_driver_ && !unsteady) {
      add_change(Kind::regression, Subject::statistic, Cause::same_driver, change);
    } else if (!on_a.is_exact() || !on_b.is_exact()) {
      add_change(Kind::calibration, Subject::statistic, Cause::counted_differently, change)
          .worths = {on_a, on_b};
    } else if (agreed) {
      add_change(Kind::regression, Subject::statistic, Cause::drivers_must_agree, change);
    } else {
      add_change(Kind::changed, Subject::statistic, Cause::drivers_may_differ, change);
    }
  }

  const ComparedSide& a_;
  const ComparedSide& b_;
  bool same_setup_;
  bool same_driver_;
  bool same_device_;
  bool same_id_;
  judge::OpenCounts open_counts_a_;
  judge::OpenCounts open_counts_b_;
  Comparison result_;
};

}  // namespace

std::vector<Difference> find_differences(const record::Device& a, const record::Device& b) {
  std::vector<Difference> differences;
  if (a.id != b.id) return differences;
  const auto changed = [](const auto& of_a, const auto& of_b, const auto& add) {
    for (const std::string& name : all_names(of_a, of_b)) {
      const auto before = of_a.find(name);
      const auto now = of_b.find(name);
      const auto* const value_a = before == of_a.end() ? nullptr : &before->second;
      const auto* const value_b = now == of_b.end() ? nullptr : &now->second;
      if (value_a == nullptr || value_b == nullptr || *value_a != *value_b) {
        add(name, value_a, value_b);
      }
    }
  };
  changed(a.limits, b.limits,
          [&](const std::string& name, const std::string* before, const std::string* now) {
            Difference& found = differences.emplace_back(
                Difference{.subject = Subject::limit, .cause = Cause::limit_changed, .name = name});
            if (before != nullptr) found.facts["a"] = *before;
            if (now != nullptr) found.facts["b"] = *now;
          });
  changed(a.statistics_calibration, b.statistics_calibration,
          [&](const std::string& name, const auto* before, const auto* now) {
            // Each run calibrates only the statistics that its techniques need: it compares the
            // driver's counts with known counts. A statistic that one of the two runs did not
            // calibrate is left out here.
            if (before == nullptr || now == nullptr) return;
            differences.push_back({.kind = Kind::calibration,
                                   .subject = Subject::statistic,
                                   .cause = Cause::calibration_changed,
                                   .name = name,
                                   .worths = {*before, *now}});
          });
  return differences;
}

Comparison find_differences(const ComparedSide& a, const ComparedSide& b, bool same_setup) {
  return DifferenceFinder(a, b, same_setup).find();
}

}  // namespace triptych::comparison
