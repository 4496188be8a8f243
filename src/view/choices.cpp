#include "view/choices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "core/error.hpp"
#include "measure/plan/plan.hpp"
#include "measure/plan/plan_values.hpp"
#include "measure/plan/plan_yaml.hpp"

namespace triptych::view {
namespace {

void add_level(std::vector<std::string>& offered_levels, const std::string& value) {
  if (std::ranges::find(offered_levels, value) == offered_levels.end())
    offered_levels.push_back(value);
}

// Sorts numbers by value, and moves other words to the end in their original order.
void sort_numbers(std::vector<std::string>& offered_levels) {
  const auto number = [](const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc{} && end == text.data() + text.size();
    return std::pair(!whole, whole ? value : 0);
  };
  std::ranges::stable_sort(offered_levels, {}, number);
}

// Returns "generate:NAME" with the size of the default data, such as ":96" in
// "generate:mandelbulb:96".
std::string generated(std::string_view name, std::string_view default_level) {
  const std::size_t colon = default_level.rfind(':');
  const std::string_view size = default_level.starts_with("generate:") ? default_level.substr(colon)
                                                                       : std::string_view(":64");
  return fmt::format("generate:{}{}", name, size);
}

// Returns the levels that a plan entry gives a factor, in their canonical spelling.
std::vector<std::string> values_of(const measure::Suite& suite, const measure::Factor& factor,
                                   const measure::PlanEntry& entry) {
  try {
    return measure::canonical_values(suite, factor, entry.values);
  } catch (const core::Error&) {
    return {};  // the file does not exist on this machine
  }
}

}  // namespace

Choices::Choices(const measure::Suite& suite, measure::Configuration first)
    : suite_(suite), first_(std::move(first)), current_(first_) {
  for (const measure::Factor& each : suite.factors()) {
    default_levels_[each.name] = measure::default_of(each);
  }
  collect_offered_levels();
}

std::string Choices::key() const {
  return measure::configuration_key(suite_, current_);
}

std::string Choices::set(const std::string& factor, std::string_view value) {
  measure::Configuration next = current_;
  next[factor] = value;
  measure::Overrides overrides;
  for (const auto& [name, level] : next) overrides.push_back({name, {level}});
  try {
    const measure::Plan plan = measure::default_plan(suite_, overrides);
    if (plan.configurations.size() != 1 || !plan.automatic.empty()) {
      return fmt::format("{}={} selects several configurations, but the window can show only one",
                         factor, value);
    }
    if (std::string missing = suite_.missing_data(plan.configurations.front()); !missing.empty()) {
      return missing;
    }
    current_ = plan.configurations.front();
    return {};
  } catch (const core::Error& error) {
    return error.what();
  }
}

void Choices::collect_offered_levels() {
  for (const measure::Factor& each : suite_.factors()) {
    std::vector<std::string>& offered_levels = offered_levels_[each.name];
    offered_levels = each.levels;
    if (!each.automatic.empty()) std::erase(offered_levels, "auto");
    if (each.kind == measure::FactorKind::choice) continue;
    add_level(offered_levels, default_levels_.at(each.name));
    if (each.name == "data") {
      for (const scene::GeneratorInfo& known : suite_.generators()) {
        add_level(offered_levels, generated(known.name, each.default_value));
      }
    }
  }
  for (const std::string_view plan : suite_.plan_names()) {
    measure::PlanText text = measure::parse_plan(suite_.plan_text(plan), std::string(plan));
    text.also.push_back(std::move(text.entries));
    for (const auto& block : text.also) {
      for (const measure::PlanEntry& entry : block) {
        const auto factor =
            std::ranges::find(suite_.factors(), entry.factor.text, &measure::Factor::name);
        if (factor == suite_.factors().end()) continue;
        if (factor->kind == measure::FactorKind::choice) continue;
        for (const std::string& value : values_of(suite_, *factor, entry)) {
          add_level(offered_levels_[factor->name], value);
        }
      }
    }
  }
  for (const measure::Factor& each : suite_.factors()) {
    if (each.kind == measure::FactorKind::number) sort_numbers(offered_levels_[each.name]);
  }
}

}  // namespace triptych::view
