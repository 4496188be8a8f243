#include "report/screen/error_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <span>

#include "report/screen/columns.hpp"
#include "report/words/requested_error.hpp"

namespace triptych::report {
namespace {

using Answers = std::span<const measure::ErrorAnswer>;

// Shortens a number in a factor level, because steps and thresholds have many digits.
std::string short_level(const record::Record& record, const std::string& factor) {
  const std::string& level = record.factors.at(factor);
  char* end = nullptr;
  const double number = std::strtod(level.c_str(), &end);
  return *end == '\0' ? fmt::format("{:.4g}", number) : level;
}

std::vector<std::string> error_row(const measure::ErrorAnswer& answer,
                                   const accuracy::RequestedError& request) {
  const record::Record& record = *answer.record;
  std::vector<std::string> row{answer.device, record.technique};
  for (const char* factor : {"step", "quadrature", "ert", "skip", "adapt"}) {
    row.push_back(short_level(record, factor));
  }
  row.push_back(fmt::format("{:.3g}", answer.errors.of(request.metric)));
  row.push_back(fmt::format("{:.3f}", answer.time->median / 1e6));
  row.push_back(
      fmt::format("{:.3f} to {:.3f}", answer.time->minimum / 1e6, answer.time->maximum / 1e6));
  const auto samples = record.counters.find("samples");
  row.push_back(samples == record.counters.end() ? "unknown" : fmt::to_string(samples->second));
  return row;
}

std::string name_in_table(const measure::ErrorAnswer& answer) {
  return fmt::format("{} with {}", answer.device, answer.record->technique);
}

// Returns the table of one scene. The first answer is the fastest.
std::string error_table(Answers answers, const accuracy::RequestedError& request) {
  std::vector<std::vector<std::string>> rows{{"device", "technique", "step", "quadrature", "ert",
                                              "skip", "adapt", "error", "time [ms]",
                                              "fastest to slowest frame", "samples"}};
  std::string missed;
  std::vector<std::string> similar;
  const measure::ErrorAnswer& best = answers.front();
  for (const measure::ErrorAnswer& each : answers) {
    if (each.record == nullptr) {
      missed += words::text_of_missed(each, request) + "\n";
      continue;
    }
    rows.push_back(error_row(each, request));
    if (&each != &best && is_not_clearly_slower(each, best)) similar.push_back(name_in_table(each));
  }
  if (best.record == nullptr) return missed;
  std::string text = fmt::format("{}\n{}", best.compared_scene, aligned_columns(rows));
  text += fmt::format("fastest: {}, {:.3f} ms ({} clock), {}\n", name_in_table(best),
                      best.time->median / 1e6, best.clock, words::text_of_errors(best, request));
  if (!similar.empty()) {
    text +=
        fmt::format("not clearly slower, because the fastest frame took at most {:.3f} ms: {}\n",
                    best.time->median / 1e6, fmt::join(similar, ", "));
  }
  return text + missed;
}

}  // namespace

std::string error_tables(const std::vector<measure::ErrorAnswer>& answers,
                         const accuracy::RequestedError& request) {
  std::string text;
  for (std::size_t i = 0; i < answers.size();) {
    std::size_t end = i + 1;
    while (end < answers.size() && answers[end].compared_scene == answers[i].compared_scene) ++end;
    text += error_table(Answers(answers).subspan(i, end - i), request);
    i = end;
  }
  return text;
}

}  // namespace triptych::report
