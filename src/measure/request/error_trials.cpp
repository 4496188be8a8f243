#include "measure/request/error_trials.hpp"

#include <fmt/format.h>

#include <limits>
#include <optional>
#include <set>
#include <tuple>

#include "measure/request/short_number.hpp"

namespace triptych::measure {
namespace {

double samples_of(const record::Record& record) {
  const auto samples = record.counters.find("samples");
  return samples == record.counters.end() ? 0.0 : static_cast<double>(samples->second);
}

}  // namespace

ErrorTrials::ErrorTrials(const Plan& plan, const ErrorSearch& search,
                         std::vector<ErrorStart> starts)
    : plan_(plan), search_(search), starts_(std::move(starts)), searches_(starts_.size()) {
  plan_.name += " trials";
  plan_.checks = {record::Check::image, record::Check::counters};
}

Configuration ErrorTrials::configuration_of(const Trial& trial) const {
  const ErrorStart& start = starts_[trial.start];
  Configuration configuration = start.configuration;
  // A fixed level keeps its spelling, because it is part of the scene's name.
  if (search_.goal.chooses("step")) {
    configuration["step"] = short_number(start.search.step_of(trial.place));
  }
  if (search_.goal.chooses("ert")) {
    configuration["ert"] = short_number(start.search.threshold_of(trial.place));
  }
  return configuration;
}

void ErrorTrials::draw(const std::map<std::string, Trial>& trials) {
  plan_.configurations.clear();
  for (const auto& [key, trial] : trials) plan_.configurations.push_back(configuration_of(trial));
  search_.draw(plan_, [&](const record::Record& record, const core::Image& image) {
    const auto trial = trials.find(record.configuration);
    const accuracy::LimitImage* limit = search_.truths.limit_of(record);
    if (trial == trials.end() || limit == nullptr) return;
    const auto& [start, place] = trial->second;
    searches_[start]
        .try_emplace(record.device, starts_[start].search)
        .first->second.add(
            place,
            {.error = accuracy::errors_against(limit->image, image).of(search_.goal.request.metric),
             .samples = samples_of(record)});
  });
}

std::vector<Configuration> ErrorTrials::run() {
  using Wanted = std::tuple<std::size_t, std::string, accuracy::BudgetPlace>;
  for (int round = 1;; ++round) {
    std::map<std::string, Trial> trials;  // by configuration key
    std::vector<Wanted> wanted;
    const auto add = [&](const Trial& trial) {
      trials.emplace(configuration_key(search_.suite, configuration_of(trial)), trial);
    };
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      if (round == 1) {
        for (const auto& place : starts_[i].search.next()) add({i, place});
        continue;
      }
      for (auto& [device, search] : searches_[i]) {
        for (const auto& place : search.next()) {
          add({i, place});
          wanted.emplace_back(i, device, place);
        }
      }
    }
    if (trials.empty()) return chosen();
    search_.report(
        {.phase = ErrorProgress::Phase::trials, .round = round, .settings = trials.size()});
    draw(trials);
    // A trial that a device could not draw must not be requested again.
    for (const auto& [start, device, place] : wanted) {
      accuracy::BudgetSearch& search = searches_[start].at(device);
      if (search.has(place)) continue;
      search.add(place, {.error = std::numeric_limits<double>::quiet_NaN()});
    }
  }
}

std::vector<Configuration> ErrorTrials::chosen() const {
  // The scenes in which a device found settings that meet the error.
  std::set<std::pair<std::string, std::string>> met;
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    for (const auto& [device, search] : searches_[i]) {
      if (search.cheapest()) met.emplace(starts_[i].scene, device);
    }
  }
  std::vector<Configuration> configurations;
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    std::set<accuracy::BudgetPlace> places;
    for (const auto& [device, search] : searches_[i]) {
      const auto place =
          met.contains({starts_[i].scene, device}) ? search.cheapest() : search.nearest();
      if (place) places.insert(*place);
    }
    // If no device could draw the scene, its records contain the reason.
    if (searches_[i].empty()) places.insert(accuracy::BudgetPlace{});
    for (const auto& place : places) configurations.push_back(configuration_of({i, place}));
  }
  return configurations;
}

}  // namespace triptych::measure
