#pragma once
// The sections of a plan's part of the page; each is HTML, empty where it has nothing to show.

#include <functional>
#include <string>
#include <vector>

#include "judge/gate.hpp"
#include "record/store.hpp"

namespace triptych::report {

struct PlanData {
  std::string anchor;  // prefix of element ids on the page
  std::vector<record::Store::DeviceEntry> devices;
  std::vector<record::Record> records;
  const judge::GateResult* verdict = nullptr;
};

[[nodiscard]] std::string verdict_section(const PlanData& plan);
[[nodiscard]] std::string devices_section(const PlanData& plan);
[[nodiscard]] std::string scenes_section(
    const record::Store& store, const PlanData& plan,
    const std::function<judge::TruthPair(const record::Record&)>& truth);
[[nodiscard]] std::string times_section(const PlanData& plan);
[[nodiscard]] std::string speed_of_light_section(const PlanData& plan);
[[nodiscard]] std::string counts_section(const PlanData& plan);

// The factors of a configuration without the technique: what its records have in common.
[[nodiscard]] std::string scene_title(const record::Record& record);

}  // namespace triptych::report
