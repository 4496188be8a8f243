// Compares the bytes that are allocated on the device with the accepted values. More bytes are a
// regression, and fewer are an improvement.

#include <set>

#include "judge/gate/run_view.hpp"

namespace triptych::judge {
namespace {

std::uint64_t bytes_of(const record::Counts& memory, const std::string& kind) {
  const auto found = memory.find(kind);
  return found == memory.end() ? 0 : found->second;
}

Finding judge(const record::Record& record, const record::Counts& stored) {
  bool more = false;
  std::vector<Change> changes;
  std::set<std::string> kinds;
  for (const auto& [kind, bytes] : stored) kinds.insert(kind);
  for (const auto& [kind, bytes] : record.memory) kinds.insert(kind);
  for (const std::string& kind : kinds) {
    const std::uint64_t before = bytes_of(stored, kind);
    const std::uint64_t now = bytes_of(record.memory, kind);
    if (now == before) continue;
    more = more || now > before;
    changes.push_back({.name = kind,
                       .unit = Unit::bytes,
                       .before = static_cast<double>(before),
                       .now = static_cast<double>(now)});
  }
  if (changes.empty()) {
    return finding_about(record, Check::memory, Verdict::pass,
                         {.cause = Cause::as_stored,
                          .against = Against::baseline,
                          .numbers = {{"values", static_cast<double>(kinds.size())}}});
  }
  return finding_about(
      record, Check::memory, more ? Verdict::regression : Verdict::improved,
      {.cause = Cause::values_changed, .against = Against::baseline, .changes = changes});
}

// The configurations for which the memory allocated on a device cannot be compared.
struct MemoryCoverage {
  bool accepted = false;     // whether memory is stored for some configuration of the device
  std::size_t reported = 0;  // number of configurations for which the device reports memory
  // configurations whose memory is stored, but not reported now
  std::vector<std::string> no_longer_reported;
  std::vector<std::string> not_stored;  // configurations whose memory is reported, but not stored
};

void report_memory_coverage(const RunView& view, const record::Device& device,
                            const MemoryCoverage& coverage, std::vector<Finding>& findings) {
  const auto add = [&](Verdict verdict, Observation observation, AdviceWithCommand advice = {}) {
    findings.push_back(finding_about(view, device, Check::memory, verdict, std::move(observation),
                                     std::move(advice)));
  };
  if (!coverage.no_longer_reported.empty()) {
    add(Verdict::cannot_judge,
        {.cause = Cause::no_longer_reported, .names = coverage.no_longer_reported});
  } else if (coverage.reported == 0) {
    add(Verdict::skipped, {.cause = Cause::not_reported});
  }
  if (coverage.not_stored.empty()) return;
  if (coverage.accepted) {
    add(Verdict::cannot_judge, {.cause = Cause::not_stored, .names = coverage.not_stored},
        view.accept_advice());
  } else {
    add(Verdict::advisory, {.cause = Cause::no_stored_device}, view.accept_advice());
  }
}

}  // namespace

std::vector<Finding> check_memory(const RunView& view) {
  std::vector<Finding> findings;
  std::map<std::string, MemoryCoverage> devices;
  for (const record::Record* record : view.measured) {
    MemoryCoverage& coverage = devices[record->device];
    const auto stored = view.baselines.memory(record->configuration);
    const auto own = stored.find(record->device);
    const bool reported = !record->memory.empty();
    coverage.accepted = coverage.accepted || own != stored.end();
    coverage.reported += reported ? 1 : 0;
    if (own == stored.end()) {
      if (reported) coverage.not_stored.push_back(record->configuration);
    } else if (!reported) {
      coverage.no_longer_reported.push_back(record->configuration);
    } else if (record->injected.find("slowdown:") != std::string::npos) {
      findings.push_back(finding_about(*record, Check::memory, Verdict::skipped,
                                       {.cause = Cause::injected_memory}));
    } else {
      findings.push_back(judge(*record, own->second));
    }
  }
  for (const auto& [id, coverage] : devices)
    report_memory_coverage(view, view.devices.at(id), coverage, findings);
  return findings;
}

}  // namespace triptych::judge
