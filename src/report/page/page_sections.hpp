#pragma once
// The sections of the page. A section is empty if there is nothing to show.

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

// The findings about an image.
struct JudgedImage {
  std::set<std::string_view> checks;  // the checks that judged the image
  // Element id of the first cause that needs attention; empty if there is none.
  std::string cause;
};
using JudgedImages = std::map<std::string, JudgedImage>;  // the key is image_id()
[[nodiscard]] JudgedImages judged_images(const Overview& all, std::span<const PlanData> plans);

struct PanelSources {
  const record::Store& store;
  const std::function<judge::TruthPair(const record::Record&)>& truth;
  const JudgedImages& judged;
};

// Returns the verdict, with links to its causes.
[[nodiscard]] Html verdict_card(const Overview& all, std::span<const PlanData> plans);
// Returns filters for the content of the page. They are hidden until the script shows them.
[[nodiscard]] Html filters(std::span<const PlanData> plans);
// Returns a table with a row for each check, and the findings grouped by cause.
[[nodiscard]] Html findings_section(const Overview& all, std::span<const PlanData> plans);
// The images of all plans. Wrong images are visible or, if no image is wrong, one image of each
// scene. All other images are folded.
struct ImagesSection {
  Html html;
  bool wrong = false;
};
[[nodiscard]] ImagesSection images_section(const PanelSources& sources,
                                           std::span<const PlanData> plans);
// Returns whether the page has a panel for the record. The panel shows the image of the record, or
// states why there is none.
[[nodiscard]] bool has_panel(const record::Record& record);
// Returns a dialog that compares two images of a scene with a slider. The script opens it.
[[nodiscard]] Html comparison_dialog();
// Returns the definitions of the terms on the page, and the documentation page for each check.
[[nodiscard]] Html terms_section(const Overview& all);
// Returns the devices of one plan.
[[nodiscard]] Html devices_section(const PlanData& plan);
// Returns the values that differ from the stored values, by check, and the changes in cost and time
// as bars.
[[nodiscard]] Html changes_section(const PlanData& plan);
[[nodiscard]] Html times_section(const PlanData& plan);
[[nodiscard]] Html speed_of_light_section(const PlanData& plan);
// Returns the statistics that GPU compilers report. For code that got worse, also shows the
// disassembly next to an earlier disassembly from the store.
[[nodiscard]] Html code_section(const record::Store& store, const PlanData& plan);
// Returns the number of samples or spheres that remain after skipping or culling, and the number of
// them that contribute to the image.
[[nodiscard]] Html needed_section(const PlanData& plan);
// Returns a scatter plot for each pair of devices, with the fitted line.
[[nodiscard]] Html correlation_section(const PlanData& plan);
// Returns figures and tables of run time against error, for plans with the check `accuracy`.
[[nodiscard]] Html accuracy_section(const PlanData& plan);
[[nodiscard]] Html counts_section(const PlanData& plan);

// Returns the suite of the plan, or "" if the plan has no records.
[[nodiscard]] std::string suite_of(const PlanData& plan);

// Returns the element id of the panel for a configuration on a device.
[[nodiscard]] std::string image_id(const PlanData& plan, const std::string& device,
                                   const std::string& configuration);

// Returns the factors that distinguish a record's scene from the other scenes of the plan: "data=…,
// camera=…". If the plan has only one scene, returns all factors that the configuration names. The
// technique is never included.
[[nodiscard]] std::string scene_title(const PlanData& plan, const record::Record& record);
// Like scene_title(), but without factors that determine only how the image is drawn, not what it
// shows.
[[nodiscard]] std::string image_title(const PlanData& plan, const record::Record& record);

// Returns the factors that all scenes of the plan have in common, or "" if there are none.
[[nodiscard]] std::string common_factors(const PlanData& plan);

}  // namespace triptych::report
