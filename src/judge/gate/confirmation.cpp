#include "judge/gate/confirmation.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "judge/gate/run_view.hpp"
#include "judge/statistics/statistics.hpp"
#include "judge/timing/anchor.hpp"
#include "judge/timing/model.hpp"

namespace triptych::judge {
namespace {

using Key = std::pair<std::string_view, std::string_view>;  // device, configuration

bool was_measured(const record::Record& record) {
  return record.outcome == record::Outcome::measured && record.same_as.empty();
}

bool is_same_program(const record::Record& a, const record::Record& b) {
  return a.kernel_hash == b.kernel_hash && a.data_hash == b.data_hash;
}

std::map<Key, const record::Record*> by_key(std::span<const record::Record> records) {
  std::map<Key, const record::Record*> result;
  for (const record::Record& record : records) {
    if (was_measured(record)) result[{record.device, record.configuration}] = &record;
  }
  return result;
}

// The first of each, the second of each and so on. variance_of_rounds holds the first half against
// the second: both launches are in both, and early and late rounds stay apart.
std::vector<double> in_turn(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result;
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    if (i < a.size()) result.push_back(a[i]);
    if (i < b.size()) result.push_back(b[i]);
  }
  return result;
}

void join(record::Record& record, const record::Record& again) {
  const bool one_clock = record.clock() == again.clock();
  if (!one_clock) {
    record.device_clock_trusted = false;
    record.rounds_ns = {median(record.wall_ns)};
  }
  record.rounds_ns = in_turn(
      record.rounds_ns, one_clock ? again.rounds_ns : std::vector<double>{median(again.wall_ns)});
  const std::string_view clock = record.clock();
  if (!(median(again.time_ns_by(clock)) < median(record.time_ns_by(clock)))) return;
  record.wall_ns = again.wall_ns;
  record.device_ns = again.device_ns;
}

// What may be slower – of the timing check's p-values, those of configurations together and each
// program's for itself – and what noise kept from being told.
std::set<std::string> in_doubt_by_history(const std::vector<Finding>& findings) {
  std::set<std::string> devices;
  std::vector<const Finding*> tested;
  std::vector<double> p;
  for (const Finding& finding : findings) {
    const auto own = finding.numbers.find("p");
    if (finding.check != Check::timing || own == finding.numbers.end()) continue;
    if (finding.verdict == Verdict::cannot_judge) devices.insert(finding.device);
    if (finding.subject == "program") {
      if (own->second <= TimingModel::false_program_suspects) devices.insert(finding.device);
    } else if (finding.numbers.contains("half_width")) {
      tested.push_back(&finding);
      p.push_back(own->second);
    }
  }
  const auto suspected = benjamini_hochberg(p, TimingModel::share_of_false_suspects);
  for (std::size_t i = 0; i < tested.size(); ++i) {
    if (suspected[i]) devices.insert(tested[i]->device);
  }
  return devices;
}

bool is_about_the_same(const Finding& a, const Finding& b) {
  return a.check == b.check && a.device == b.device && a.configuration == b.configuration &&
         a.subject == b.subject;
}

}  // namespace

std::set<std::string> measured_again(std::span<const record::Record> records, const Launch& again) {
  const std::vector<record::Record> others = again.store->records(again.run);
  const auto there = by_key(others);
  std::set<std::string> devices;
  std::set<std::string> in_part;
  for (const record::Record& record : records) {
    if (!was_measured(record)) continue;
    const auto own = there.find({record.device, record.configuration});
    const bool whole = own != there.end() && is_same_program(record, *own->second);
    (whole ? devices : in_part).insert(record.device);
  }
  for (const std::string& device : in_part) devices.erase(device);
  if (again.devices) {
    std::erase_if(devices, [&](const std::string& id) { return !again.devices->contains(id); });
  }
  return devices;
}

void join_launches(std::vector<record::Record>& records, std::span<const record::Record> again,
                   const std::set<std::string>& devices) {
  const auto others = by_key(again);
  for (record::Record& record : records) {
    const auto other = others.find({record.device, record.configuration});
    const bool both = other != others.end() && was_measured(record) &&
                      devices.contains(record.device) && !record.time_ns().empty() &&
                      !other->second->time_ns().empty();
    if (both) join(record, *other->second);
  }
}

std::set<std::string> devices_in_doubt(const GateResult& result) {
  if (result.plan == anchors_plan) return {};  // no program that could be slower
  return in_doubt_by_history(result.findings);
}

void tell_what_was_taken_back(const GateResult& first, GateResult& all) {
  for (Finding& finding : all.findings) {
    if (is_slower(finding) && all.measured_again.contains(finding.device)) {
      finding.message += "; so too on a fresh launch";
    }
  }
  for (const Finding& finding : first.findings) {
    if (!is_slower(finding) || !all.measured_again.contains(finding.device)) continue;
    auto now = std::ranges::find_if(
        all.findings, [&](const Finding& each) { return is_about_the_same(each, finding); });
    if (now == all.findings.end()) {
      now = all.findings.insert(now, finding);
    } else if (is_slower(*now)) {
      continue;
    }
    if (now->verdict != Verdict::cannot_judge) now->verdict = Verdict::advisory;
    now->message += "; slower in the first launch, not so on a fresh launch";
  }
}

}  // namespace triptych::judge
