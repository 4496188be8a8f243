#include <map>
#include <set>

#include "record/factor_list.hpp"
#include "report/page/page_sections.hpp"

namespace triptych::report {
namespace {

using Factors = std::map<std::string, std::string>;

// Returns the factors in a configuration or scene key, "camera=…,data=…", without the technique.
Factors named_factors(const std::string& key) {
  Factors factors = record::parse_factor_list(key);
  factors.erase("technique");
  return factors;
}

// Returns the factors that have the same level in all configurations of the plan. Leaves out
// factors that some configurations do not name.
Factors shared(const PlanData& plan) {
  std::map<std::string, std::set<std::string>> values;
  std::map<std::string, std::size_t> named;
  for (const record::Record& record : plan.records) {
    for (const auto& [name, value] : named_factors(record.configuration)) {
      values[name].insert(value);
      ++named[name];
    }
  }
  Factors common;
  for (const auto& [name, seen] : values) {
    if (seen.size() == 1 && named[name] == plan.records.size()) common[name] = *seen.begin();
  }
  return common;
}

std::string joined(const Factors& factors) {
  std::string text;
  for (const auto& [name, value] : factors) {
    text += (text.empty() ? "" : ", ") + name + "=" + value;
  }
  return text;
}

// Returns the factors that distinguish the scene from the other scenes of the plan, or all factors
// if there are none.
std::string without_shared(const PlanData& plan, const Factors& factors) {
  Factors own = factors;
  for (const auto& [name, value] : shared(plan)) own.erase(name);
  return joined(own.empty() ? factors : own);
}

}  // namespace

std::string scene_title(const PlanData& plan, const record::Record& record) {
  return without_shared(plan, named_factors(record.configuration));
}

std::string image_title(const PlanData& plan, const record::Record& record) {
  Factors own = named_factors(record.configuration);
  const Factors of_scene = named_factors(record.scene);
  std::erase_if(own, [&](const auto& factor) { return !of_scene.contains(factor.first); });
  return without_shared(plan, own);
}

std::string common_factors(const PlanData& plan) {
  return joined(shared(plan));
}

}  // namespace triptych::report
