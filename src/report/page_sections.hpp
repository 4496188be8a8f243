#pragma once
// The sections of the page; each is HTML, empty where it has nothing to show.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"
#include "record/store.hpp"

namespace triptych::report {

struct PlanData {
  std::string anchor;  // prefix of element ids on the page
  std::string name;
  std::vector<record::Store::DeviceEntry> devices;
  std::vector<record::Record> records;
  const judge::GateResult* verdict = nullptr;
};

// The verdict, the row of each kind of check, the findings by cause.
[[nodiscard]] std::string verdict_section(std::span<const PlanData> plans);
// Of all plans: what is wrong first, else a picture of each scene; the others folded.
[[nodiscard]] std::string pictures_section(
    const record::Store& store, std::span<const PlanData> plans,
    const std::function<judge::TruthPair(const record::Record&)>& truth);
// Of one plan.
[[nodiscard]] std::string devices_section(const PlanData& plan);
[[nodiscard]] std::string times_section(const PlanData& plan);
[[nodiscard]] std::string speed_of_light_section(const PlanData& plan);
// Of each pair of devices, what keeps step and what is off its line.
[[nodiscard]] std::string correlation_section(const PlanData& plan);
// Of the scenes whose accuracy the verdict tells.
[[nodiscard]] std::string accuracy_section(const PlanData& plan);
[[nodiscard]] std::string counts_section(const PlanData& plan);

// The element id of what was drawn of a configuration on a device.
[[nodiscard]] std::string picture_id(const PlanData& plan, const std::string& device,
                                     const std::string& configuration);

// The factors that tell a record's scene from the plan's others, "data=…, camera=…"; all that its
// configuration names where the plan has one scene only. The technique is never among them.
[[nodiscard]] std::string scene_title(const PlanData& plan, const record::Record& record);
// The same without the factors that decide only how the picture is made.
[[nodiscard]] std::string picture_title(const PlanData& plan, const record::Record& record);

// What all scenes of the plan have in common; empty when that is nothing.
[[nodiscard]] std::string common_factors(const PlanData& plan);

}  // namespace triptych::report
