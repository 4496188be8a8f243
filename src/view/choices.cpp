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

void offer(std::vector<std::string>& offers, const std::string& value) {
  if (std::ranges::find(offers, value) == offers.end()) offers.push_back(value);
}

// Sorts numbers by value, and moves other words to the end in their original order.
void sort_numbers(std::vector<std::string>& offers) {
  const auto number = [](const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc{} && end == text.data() + text.size();
    return std::pair(!whole, whole ? value : 0);
  };
  std::ranges::stable_sort(offers, {}, number);
}

// Returns "generate:NAME" with the size of the default data, such as ":96" in
// "generate:mandelbulb:96".
std::string generated(std::string_view name, std::string_view standard) {
  const std::size_t colon = standard.rfind(':');
  const std::string_view size =
      standard.starts_with("generate:") ? standard.substr(colon) : std::string_view(":64");
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
    : suite_(suite), first_(std::move(first)), now_(first_) {
  for (const measure::Factor& each : suite.factors()) {
    standard_[each.name] = measure::standard_of(each);
  }
  collect_offers();
}

std::string Choices::key() const {
  return measure::configuration_key(suite_, now_);
}

std::string Choices::set(const std::string& factor, std::string_view value) {
  measure::Configuration next = now_;
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
    now_ = plan.configurations.front();
    return {};
  } catch (const core::Error& error) {
    return error.what();
  }
}

void Choices::collect_offers() {
  for (const measure::Factor& each : suite_.factors()) {
    std::vector<std::string>& offers = offers_[each.name];
    offers = each.levels;
    if (!each.automatic.empty()) std::erase(offers, "auto");
    if (each.kind == measure::FactorKind::choice) continue;
    offer(offers, standard_.at(each.name));
    if (each.name == "data") {
      for (const scene::GeneratorInfo& known : suite_.generators()) {
        offer(offers, generated(known.name, each.standard));
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
          offer(offers_[factor->name], value);
        }
      }
    }
  }
  for (const measure::Factor& each : suite_.factors()) {
    if (each.kind == measure::FactorKind::number) sort_numbers(offers_[each.name]);
  }
}

}  // namespace triptych::view
