#pragma once
// The sections of the page; each is HTML, empty where it has nothing to show.

#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/html.hpp"
#include "judge/gate/gate.hpp"
#include "record/store.hpp"
#include "report/overview.hpp"

namespace triptych::report {

struct PlanData {
  std::string prefix;  // of element ids on the page
  std::string name;
  std::vector<record::Store::DeviceEntry> devices;
  std::vector<record::Record> records;
  const judge::GateResult* verdict = nullptr;
};

// What was said of a picture.
struct Judged {
  std::set<std::string_view> checks;
  std::string cause;  // element id of the first open one; empty where there is none
};
using JudgedPictures = std::map<std::string, Judged>;  // by picture_id
[[nodiscard]] JudgedPictures judged_pictures(const Overview& all, std::span<const PlanData> plans);

struct PictureSources {
  const record::Store& store;
  const std::function<judge::TruthPair(const record::Record&)>& truth;
  const JudgedPictures& judged;
};

// The verdict with links to its causes.
[[nodiscard]] Html verdict_card(const Overview& all, std::span<const PlanData> plans);
// Of what the page is about; hidden until its script shows them.
[[nodiscard]] Html filters(std::span<const PlanData> plans);
// The row of each kind of check, the findings by cause.
[[nodiscard]] Html findings_section(const Overview& all, std::span<const PlanData> plans);
// Of all plans: what is wrong first, else a picture of each scene; the others folded.
struct Pictures {
  Html html;
  bool wrong = false;
};
[[nodiscard]] Pictures pictures_section(const PictureSources& sources,
                                        std::span<const PlanData> plans);
// Whether it drew a picture, or ended instead of drawing one.
[[nodiscard]] bool has_tile(const record::Record& record);
// Two pictures of a scene under a slider; closed until its script opens it.
[[nodiscard]] Html comparison_dialog();
// Of one plan.
[[nodiscard]] Html devices_section(const PlanData& plan);
// Cost and times beside what is stored, as bars.
[[nodiscard]] Html changes_section(const PlanData& plan);
[[nodiscard]] Html times_section(const PlanData& plan);
[[nodiscard]] Html speed_of_light_section(const PlanData& plan);
// The compilers' reports, with the disassembly of worse code beside an earlier one from the store.
[[nodiscard]] Html code_section(const record::Store& store, const PlanData& plan);
// Samples and spheres that skipping and culling leave, and how many of them show.
[[nodiscard]] Html needed_section(const PlanData& plan);
// Of each pair of devices, what keeps step and what is off its line.
[[nodiscard]] Html correlation_section(const PlanData& plan);
// Of the scenes whose accuracy the verdict tells.
[[nodiscard]] Html accuracy_section(const PlanData& plan);
[[nodiscard]] Html counts_section(const PlanData& plan);

// Empty where nothing was recorded.
[[nodiscard]] std::string suite_of(const PlanData& plan);

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
