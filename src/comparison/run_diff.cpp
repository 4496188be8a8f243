#include "comparison/run_diff.hpp"

#include <map>
#include <utility>

#include "judge/code/code_totals.hpp"

namespace triptych::comparison {
namespace {

void set_injected(const record::Record& a, const record::Record& b,
                  std::vector<Difference>& differences) {
  const std::string& injected = b.injected.empty() ? a.injected : b.injected;
  for (Difference& each : differences) each.injected = injected;
}

// Adds one difference for each statistic whose total over the whole plan changed.
void add_totals(const judge::CodeTotals& totals, std::vector<Difference>& differences) {
  for (const auto& [name, total] : totals.totals()) {
    if (total.helped + total.hurt == 0) continue;
    differences.push_back({.subject = Subject::code_total,
                           .cause = DifferenceCause::code_total,
                           .name = name,
                           .total = total});
  }
}

class RunComparer {
 public:
  RunComparer(const RunSide& a, const RunSide& b, measure::Truths& truths, bool same_setup)
      : a_(a), b_(b), truths_(truths), same_setup_(same_setup) {}

  [[nodiscard]] ConfigurationDiff compare(const record::Record& a, const record::Record& b) const {
    const core::Image image_a = image_of(a_, a);
    const core::Image image_b = image_of(b_, b);
    const judge::FindOpenCounts open_counts = [this](const record::Record& record) {
      return truths_.open_counts_of(record);
    };
    ComparedSide side_a{a, a_.device, image_a, nullptr, {}, open_counts};
    ComparedSide side_b{b, b_.device, image_b, nullptr, {}, open_counts};
    add_reference(side_a);
    add_reference(side_b);
    Comparison found = find_differences(side_a, side_b, same_setup_);
    set_injected(a, b, found.differences);
    return {.key = a.configuration,
            .differences = std::move(found.differences),
            .no_time = std::move(found.no_time),
            .ended = ended(a, b),
            .work = judge::work_change(b.counters, a.counters),
            .device_clock_trusted = {a.device_clock_trusted, b.device_clock_trusted}};
  }

  static ConfigurationDiff one_sided(measure::Side side, const record::Record& record) {
    return {.key = record.configuration,
            .differences = {{.kind = DifferenceKind::unjudged,
                             .subject = Subject::outcome,
                             .cause = DifferenceCause::only_one_side,
                             .side = side}},
            .no_time = {.cause = TimeCause::only_one_side, .side = side},
            .ended = record::Outcome::skipped,
            .work = {},
            .device_clock_trusted = {}};
  }

 private:
  static core::Image image_of(const RunSide& side, const record::Record& record) {
    return record.image.empty() ? core::Image() : side.store.decoded_image(record.image);
  }

  static std::optional<record::Outcome> ended(const record::Record& a, const record::Record& b) {
    for (const record::Record* each : {&b, &a}) {
      if (each->outcome != record::Outcome::measured) return each->outcome;
    }
    return std::nullopt;
  }

  void add_reference(ComparedSide& side) const {
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

}  // namespace

RunDiff diff_runs(const RunSide& a, const RunSide& b, measure::Truths& truths, bool same_setup) {
  const RunComparer comparer(a, b, truths, same_setup);
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
    diff.configurations.push_back(found ? comparer.compare(record, found.mapped())
                                        : RunComparer::one_sided(measure::Side::a, record));
  }
  for (const auto& [key, record] : of_b) {
    diff.configurations.push_back(RunComparer::one_sided(measure::Side::b, record));
  }
  add_totals(totals, diff.device);
  return diff;
}

}  // namespace triptych::comparison
