#pragma once
// The sections of the page. Each is HTML, and empty if there is nothing to show.

#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "judge/gate/gate.hpp"
#include "record/store.hpp"
#include "report/html.hpp"
#include "report/overview.hpp"

namespace triptych::report {

struct PlanData {
  std::string prefix;  // prefix of element ids on the page
  std::string name;
  std::vector<record::Store::DeviceEntry> devices;
  std::vector<record::Record> records;
  const judge::GateResult* verdict = nullptr;
  const record::Run* run = nullptr;
};

// The judgement of an image.
struct Judged {
  std::set<std::string_view> checks;
  std::string cause;  // element id of the first open cause; empty if there is none
};
using JudgedPictures = std::map<std::string, Judged>;  // the key is picture_id()
[[nodiscard]] JudgedPictures judged_pictures(const Overview& all, std::span<const PlanData> plans);

struct PictureSources {
  const record::Store& store;
  const std::function<judge::TruthPair(const record::Record&)>& truth;
  const JudgedPictures& judged;
};

// The verdict with links to its causes.
[[nodiscard]] Html verdict_card(const Overview& all, std::span<const PlanData> plans);
// Filters for the content of the page. They are hidden until the script shows them.
[[nodiscard]] Html filters(std::span<const PlanData> plans);
// The row of each kind of check, and the findings by cause.
[[nodiscard]] Html findings_section(const Overview& all, std::span<const PlanData> plans);
// Images of all plans: first the wrong ones, or an image of each scene if all are right. The others
// are folded.
struct Pictures {
  Html html;
  bool wrong = false;
};
[[nodiscard]] Pictures pictures_section(const PictureSources& sources,
                                        std::span<const PlanData> plans);
// Whether the page has a panel for the record: with its image, or with the way in which the program
// ended.
[[nodiscard]] bool has_tile(const record::Record& record);
// Two images of a scene under a slider; closed until the script opens it.
[[nodiscard]] Html comparison_dialog();
// The meaning of the words on the page, and the documentation of each check.
[[nodiscard]] Html words_section(const Overview& all);
// The devices of one plan.
[[nodiscard]] Html devices_section(const PlanData& plan);
// Every value that differs from the stored one, by check, and cost and times as bars.
[[nodiscard]] Html changes_section(const PlanData& plan);
[[nodiscard]] Html times_section(const PlanData& plan);
[[nodiscard]] Html speed_of_light_section(const PlanData& plan);
// The compilers' reports. The disassembly of code that got worse is shown next to an earlier one
// from the store.
[[nodiscard]] Html code_section(const record::Store& store, const PlanData& plan);
// The samples and spheres that remain after skipping and culling, and how many of them are visible.
[[nodiscard]] Html needed_section(const PlanData& plan);
// For each pair of devices, the configurations that are on the line and those that are not.
[[nodiscard]] Html correlation_section(const PlanData& plan);
// The scenes whose accuracy is part of the verdict.
[[nodiscard]] Html accuracy_section(const PlanData& plan);
[[nodiscard]] Html counts_section(const PlanData& plan);

// Empty if nothing was recorded.
[[nodiscard]] std::string suite_of(const PlanData& plan);

// The element id of the panel for a configuration on a device.
[[nodiscard]] std::string picture_id(const PlanData& plan, const std::string& device,
                                     const std::string& configuration);

// The factors that distinguish a record's scene from the other scenes of the plan, "data=…,
// camera=…". If the plan has only one scene, all factors that the configuration names. The
// technique is never among them.
[[nodiscard]] std::string scene_title(const PlanData& plan, const record::Record& record);
// The same without factors that only determine how the image is drawn.
[[nodiscard]] std::string picture_title(const PlanData& plan, const record::Record& record);

// The factors that all scenes of the plan have in common; empty if there are none.
[[nodiscard]] std::string common_factors(const PlanData& plan);

}  // namespace triptych::report
