#include "comparison/run_diff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "judge/code/code_totals.hpp"

namespace triptych::comparison {
namespace {

// Nobody shall take it for a driver's.
void name_injected(const record::Record& a, const record::Record& b,
                   std::vector<Difference>& differences) {
  const std::string& injected = b.injected.empty() ? a.injected : b.injected;
  if (injected.empty()) return;
  for (Difference& each : differences) {
    each.injected = injected;
    each.text += fmt::format(" [injected: {}]", injected);
  }
}

// Adds the totals over the whole plan, one difference per statistic.
void add_totals(const judge::CodeTotals& totals, std::vector<Difference>& differences) {
  if (totals.changed() == 0) return;
  for (const std::string& line : totals.lines()) {
    const std::size_t colon = line.find(": ");
    differences.push_back({DifferenceKind::changed, "code total " + line.substr(0, colon),
                           line.substr(colon + 2)});
  }
}

class Differ {
 public:
  Differ(const RunSide& a, const RunSide& b, measure::Truths& truths, bool same_setup)
      : a_(a), b_(b), truths_(truths), same_setup_(same_setup) {}

  [[nodiscard]] ConfigurationDiff both(const record::Record& a, const record::Record& b) const {
    const core::Image image_a = picture(a_, a);
    const core::Image image_b = picture(b_, b);
    const judge::FindOpenCounts open_counts = [this](const record::Record& record) {
      return truths_.open_counts_of(record);
    };
    ComparedSide side_a{a, a_.device, image_a, nullptr, {}, open_counts};
    ComparedSide side_b{b, b_.device, image_b, nullptr, {}, open_counts};
    find_truth(side_a);
    find_truth(side_b);
    Comparison found = find_differences(side_a, side_b, same_setup_);
    name_injected(a, b, found.differences);
    return {.key = a.configuration,
            .differences = std::move(found.differences),
            .void_time = std::move(found.void_time),
            .ended = ended(a, b),
            .work = judge::work_change(b.counters, a.counters),
            .device_clock_trusted = {a.device_clock_trusted, b.device_clock_trusted}};
  }

  static ConfigurationDiff one(std::string_view side, const record::Record& record) {
    return {
        .key = record.configuration,
        .differences = {{DifferenceKind::unjudged, "outcome", fmt::format("only {} has it", side)}},
        .void_time = fmt::format("only {} has it", side),
        .ended = record::Outcome::skipped,
        .work = {},
        .device_clock_trusted = {}};
  }

 private:
  static core::Image picture(const RunSide& side, const record::Record& record) {
    return record.image.empty() ? core::Image() : side.store.picture(record.image);
  }

  static std::optional<record::Outcome> ended(const record::Record& a, const record::Record& b) {
    for (const record::Record* each : {&b, &a}) {
      if (each->outcome != record::Outcome::measured) return each->outcome;
    }
    return std::nullopt;
  }

  void find_truth(ComparedSide& side) const {
    if (side.record.image.empty()) return;
    try {
      side.truth = &truths_.of(side.record);
    } catch (const core::Error& error) {
      side.no_truth = error.what();
    }
  }

  const RunSide& a_;
  const RunSide& b_;
  measure::Truths& truths_;
  bool same_setup_;
};

std::vector<record::Record> records_of(const RunSide& side) {
  std::vector<record::Record> records = side.store.records(side.run);
  std::erase_if(records, [&](const auto& each) { return each.device != side.device.id; });
  return records;
}

std::string range_of(const std::pair<double, double>& ratios) {
  const auto percent = [](double ratio) { return fmt::format("{:+.3g} %", 100 * (ratio - 1)); };
  const std::string least = percent(ratios.first);
  const std::string largest = percent(ratios.second);
  return least == largest ? least : least + " to " + largest;
}

}  // namespace

RunDiff diff_runs(const RunSide& a, const RunSide& b, measure::Truths& truths, bool same_setup) {
  const Differ differ(a, b, truths, same_setup);
  RunDiff diff{.device = find_differences(a.device, b.device), .configurations = {}};
  std::map<std::string, record::Record> of_b;
  for (record::Record& record : records_of(b)) {
    std::string key = record.configuration;
    of_b.insert_or_assign(std::move(key), std::move(record));
  }
  judge::CodeTotals totals;
  for (const record::Record& record : records_of(a)) {
    const auto found = of_b.extract(record.configuration);
    if (found) totals.add(record.configuration, record.code, found.mapped().code);
    diff.configurations.push_back(found ? differ.both(record, found.mapped())
                                        : Differ::one("a", record));
  }
  for (const auto& [key, record] : of_b) diff.configurations.push_back(Differ::one("b", record));
  add_totals(totals, diff.device);
  return diff;
}

std::string nothing_compared(const std::string& reason) {
  return fmt::format("nothing was compared: no configuration was measured on both sides{}\n",
                     reason.empty() ? "" : "; " + reason);
}

void DifferenceGroups::add(const std::vector<Difference>& differences, const std::string& where) {
  for (const Difference& each : differences) add(each, where);
}

void DifferenceGroups::add(const Difference& difference, const std::string& where) {
  DifferenceGroup& group =
      groups_
          .try_emplace({difference.kind, difference.about, difference.injected},
                       DifferenceGroup{.text = difference.text, .where = where, .ratios = {}})
          .first->second;
  ++group.count;
  if (!difference.ratio) return;
  const double ratio = *difference.ratio;
  const auto size = [](double each) { return std::abs(std::log(each)); };
  auto& ratios = group.ratios;
  if (!ratios || size(ratio) > std::max(size(ratios->first), size(ratios->second))) {
    group.text = difference.text;
    group.where = where;
  }
  ratios = ratios ? std::pair(std::min(ratios->first, ratio), std::max(ratios->second, ratio))
                  : std::pair(ratio, ratio);
}

std::string DifferenceGroups::text() const {
  std::string text;
  for (const auto& [key, group] : groups_) {
    const auto& [kind, about, injected] = key;
    text += fmt::format("{:<12}  {}: ", name_of(kind), about);
    if (group.count > 1) {
      if (group.ratios) text += range_of(*group.ratios) + " ";
      text += fmt::format("in {} configurations, {} ", group.count,
                          group.ratios ? "most in" : "first in");
    }
    text += group.where.empty() ? group.text : fmt::format("{}: {}", group.where, group.text);
    text += "\n";
  }
  return text;
}

}  // namespace triptych::comparison
