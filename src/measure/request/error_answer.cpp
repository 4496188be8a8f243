#include "measure/request/error_answer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "accuracy/choice.hpp"
#include "record/factor_list.hpp"

namespace triptych::measure {
namespace {

// The candidates of one device for a scene, which were drawn and whose errors are known.
struct DrawnCandidates {
  std::string compared_scene;
  std::vector<const record::Record*> records;
  std::vector<accuracy::ErrorsByMetric> errors;
  accuracy::ErrorsByMetric empty_image;
};

std::string without_technique(const std::string& scene) {
  auto factors = record::parse_factor_list(scene);
  std::erase_if(factors, [](const auto& level) { return level.first == "technique"; });
  return record::factor_list(factors);
}

ErrorAnswer fastest_within(const DrawnCandidates& drawn, const accuracy::RequestedError& request,
                           std::string_view clock) {
  ErrorAnswer answer{
      .compared_scene = drawn.compared_scene, .empty_image = drawn.empty_image, .clock = clock};
  if (drawn.records.empty()) return answer;
  std::vector<accuracy::TimedError> cases;
  for (std::size_t i = 0; i < drawn.records.size(); ++i) {
    const auto summary = record::summarise(drawn.records[i]->time_ns_by(clock));
    cases.push_back({summary ? std::optional(summary->median) : std::nullopt,
                     drawn.errors[i].of(request.metric)});
  }
  const auto best = accuracy::cheapest(cases, request.error);
  const auto nearest = std::ranges::min_element(cases, {}, &accuracy::TimedError::error);
  answer.errors = drawn.errors[best.value_or(static_cast<std::size_t>(nearest - cases.begin()))];
  if (best) {
    answer.record = drawn.records[*best];
    answer.time = record::summarise(answer.record->time_ns_by(clock));
  }
  return answer;
}

}  // namespace

std::vector<ErrorAnswer> answer_error(const std::vector<record::Record>& records,
                                      const Suite& suite, const ErrorGoal& goal, Truths& truths) {
  std::map<std::pair<std::string, std::string>, DrawnCandidates> groups;
  std::set<std::string> need_wall_clock;  // values of `compared_scene`
  for (const record::Record& record : records) {
    if (record.outcome == record::Outcome::skipped) continue;
    // Uses the levels that the plan requested. record.factors cannot be used, because it contains
    // resolved levels where the plan has "auto".
    const Configuration requested = record::parse_factor_list(record.configuration);
    const std::string scene = scene_of(suite, requested, goal);
    DrawnCandidates& group = groups[{record.device, scene}];
    group.compared_scene = without_technique(scene);
    if (record.outcome != record::Outcome::measured || record.image.empty()) continue;
    const accuracy::LimitImage* limit = truths.limit_of(record);
    if (limit == nullptr) continue;
    const auto errors = accuracy::errors_against(limit->image, truths.image_of(record));
    if (!std::isfinite(errors.of(goal.request.metric))) continue;
    group.records.push_back(&record);
    group.errors.push_back(errors);
    group.empty_image = accuracy::errors_of_empty_image(limit->image);
    if (record.clock() != "device") need_wall_clock.insert(group.compared_scene);
  }
  std::vector<ErrorAnswer> answers;
  for (const auto& [key, group] : groups) {
    const bool by_wall = need_wall_clock.contains(group.compared_scene);
    answers.push_back(fastest_within(group, goal.request, by_wall ? "wall" : "device"));
    answers.back().device = key.first;
    answers.back().scene = key.second;
  }
  std::ranges::stable_sort(answers, {}, [](const ErrorAnswer& answer) {
    const double time = answer.time ? answer.time->median : std::numeric_limits<double>::infinity();
    return std::tuple(answer.compared_scene, time);
  });
  return answers;
}

bool is_not_clearly_slower(const ErrorAnswer& other, const ErrorAnswer& best) {
  return other.time && best.time && other.time->minimum <= best.time->median;
}

std::vector<record::Record> answer_records(const std::vector<ErrorAnswer>& answers) {
  std::vector<record::Record> records;
  for (const ErrorAnswer& answer : answers) {
    if (answer.record == nullptr) continue;
    record::Record& record = records.emplace_back(*answer.record);
    record.configuration = answer.scene;
  }
  return records;
}

}  // namespace triptych::measure
