// Bytes allocated on the device, exact on the device that was accepted.

#include <fmt/format.h>

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
  std::vector<std::string> changes;
  std::set<std::string> kinds;
  for (const auto& [kind, bytes] : stored) kinds.insert(kind);
  for (const auto& [kind, bytes] : record.memory) kinds.insert(kind);
  for (const std::string& kind : kinds) {
    const std::uint64_t before = bytes_of(stored, kind);
    const std::uint64_t now = bytes_of(record.memory, kind);
    if (now == before) continue;
    more = more || now > before;
    changes.push_back(fmt::format("{} {} → {} bytes", kind, before, now));
  }
  if (changes.empty()) {
    return finding_about(record, Check::memory, Verdict::pass,
                         fmt::format("{} kinds of memory as stored", kinds.size()));
  }
  return finding_about(record, Check::memory, more ? Verdict::regression : Verdict::improved,
                       fmt::format("{}", fmt::join(changes, "; ")));
}

struct Untold {
  bool accepted = false;  // some configuration of the device is stored
  std::size_t told = 0;
  std::vector<std::string> lost;        // stored, and not told now
  std::vector<std::string> not_stored;  // told, and not stored
};

void tell(const RunView& view, const record::Device& device, const Untold& untold,
          std::vector<Finding>& findings) {
  const auto add = [&](Verdict verdict, std::string message) {
    findings.push_back(finding_about(view, device, Check::memory, verdict, std::move(message)));
  };
  if (!untold.lost.empty()) {
    add(Verdict::cannot_judge,
        fmt::format("the memory of {} was not told; it was when they were accepted",
                    examples_of(untold.lost)));
  } else if (untold.told == 0) {
    add(Verdict::skipped, "it does not tell what memory it takes");
  }
  if (untold.not_stored.empty()) return;
  add(untold.accepted ? Verdict::cannot_judge : Verdict::advisory,
      fmt::format(
          "no stored memory {}; accept it: {}",
          untold.accepted ? "for " + examples_of(untold.not_stored) : std::string("of this device"),
          view.accept_command()));
}

}  // namespace

std::vector<Finding> check_memory(const RunView& view) {
  std::vector<Finding> findings;
  std::map<std::string, Untold> devices;
  for (const record::Record* record : view.measured) {
    Untold& untold = devices[record->device];
    const auto stored = view.baselines.memory(record->configuration);
    const auto own = stored.find(record->device);
    const bool told = !record->memory.empty();
    untold.accepted = untold.accepted || own != stored.end();
    untold.told += told ? 1 : 0;
    if (own == stored.end()) {
      if (told) untold.not_stored.push_back(record->configuration);
    } else if (!told) {
      untold.lost.push_back(record->configuration);
    } else if (record->injected.find("slowdown:") != std::string::npos) {
      findings.push_back(finding_about(*record, Check::memory, Verdict::skipped,
                                       "what an injected slowdown draws again takes memory"));
    } else {
      findings.push_back(judge(*record, own->second));
    }
  }
  for (const auto& [id, untold] : devices) tell(view, view.devices.at(id), untold, findings);
  return findings;
}

}  // namespace triptych::judge
