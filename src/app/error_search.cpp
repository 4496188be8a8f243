#include "app/error_search.hpp"

#include "app/terminal.hpp"
#include "core/temporary_folder.hpp"
#include "report/words/requested_error.hpp"

namespace triptych::app {
namespace {

// Estimating a step takes seconds. A terminal shows a line during this time, which is removed when
// the step has been found. A log does not contain this line.
void print_search(const measure::ErrorProgress& progress) {
  const std::string text = report::words::text_of(progress);
  if (progress.phase == measure::ErrorProgress::Phase::step_search) {
    if (stderr_is_terminal()) show_progress_line(text);
    return;
  }
  clear_line();
  print_err("{}\n", text);
}

}  // namespace

measure::ErrorRequest search_settings(const measure::Plan& plan, measure::SuiteWithTruth& suite,
                                      const measure::ErrorGoal& goal, measure::Truths& truths,
                                      const MeasureTrials& measure_trials) {
  const core::TemporaryFolder folder;
  record::Store store(folder.path() / "trials.sqlite", record::Store::Mode::append);
  const auto draw = [&](const measure::Plan& trials, const measure::UseTrial& use) {
    const std::string run = measure_trials(trials, store);
    for (const record::Record& record : store.records(run)) {
      if (record.outcome != record::Outcome::measured || record.image.empty()) continue;
      use(record, store.decoded_image(record.image));
    }
  };
  return measure::request_error(plan, {suite, goal, truths, draw, print_search});
}

std::set<std::string> names_of(const measure::Overrides& overrides) {
  std::set<std::string> names;
  for (const auto& [factor, levels] : overrides) names.insert(factor);
  return names;
}

}  // namespace triptych::app
