#include "report/screen/progress_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/quoting.hpp"
#include "record/short_name.hpp"
#include "report/words/outcome.hpp"

namespace triptych::report {
namespace {

// The maximum number of failures that a log reports for each device of a plan.
constexpr int max_failures_per_device = 3;
constexpr std::string_view clear_line = "\r\033[K";

std::string time_of(const record::Record& record) {
  const auto summary = record::summarise(record.time_ns());
  return summary ? fmt::format("{:.3f} ms ({})", summary->median / 1e6, record.clock())
                 : "measured";
}

std::string outcome_of(const record::Record& record) {
  if (record.outcome != record::Outcome::measured) {
    return words::text_of(record.outcome, record.reason);
  }
  if (record.same_as.empty()) return time_of(record);
  return fmt::format("reuses the frames of {} ({})", record::short_name(record.same_as),
                     words::text_of(record.reason));
}

// Returns a title and a bar, such as "volume/quick [#####...............]".
std::string bar_of(std::string_view title, int done, int total, int cells = 20) {
  const int full = total > 0 ? cells * done / total : 0;
  return fmt::format("{} [{:#>{}}{:.>{}}]", title, "", full, "", cells - full);
}

bool is_failure(const record::Record& record) {
  return record.outcome != record::Outcome::measured && record.outcome != record::Outcome::skipped;
}

}  // namespace

std::string rounded_duration(std::chrono::seconds time) {
  const auto seconds = time.count();
  if (seconds < 120) return fmt::format("{} s", seconds);
  if (seconds < 7200) return fmt::format("{} min", (seconds + 59) / 60);
  return fmt::format("{} h", (seconds + 3599) / 3600);
}

Heartbeat::Heartbeat(std::function<Clock::time_point()> now)
    : now_(std::move(now)), started_(now_()), last_(started_) {}

bool Heartbeat::due() {
  const Clock::time_point now = now_();
  const auto interval = std::max<Clock::duration>(std::chrono::seconds(30), (now - started_) / 5);
  if (now - last_ < interval) return false;
  last_ = now;
  return true;
}

void Heartbeat::restart() {
  last_ = now_();
}

ProgressLog::ProgressLog(Options options)
    : options_(std::move(options)),
      heartbeat_(options_.now),
      started_(options_.now()),
      last_(started_) {}

int ProgressLog::planned_in_all() const {
  int planned = 0;
  for (const auto& [plan, count] : options_.planned) planned += count;
  return planned;
}

std::size_t ProgressLog::number_of_plan(std::string_view plan) const {
  const auto found = std::ranges::find(options_.planned, plan, &std::pair<std::string, int>::first);
  return static_cast<std::size_t>(found - options_.planned.begin()) + 1;
}

std::chrono::seconds ProgressLog::time_left(const Step& step) const {
  if (!has_several_plans()) return step.left;
  if (done_ == 0) return {};
  const std::chrono::duration<double> elapsed = last_ - started_;
  const double share = static_cast<double>(std::max(planned_in_all() - done_, 0)) / done_;
  return std::chrono::round<std::chrono::seconds>(elapsed * share);
}

void ProgressLog::count(const record::Record& record) {
  const Clock::time_point started = std::exchange(last_, options_.now());
  Tally& tally =
      tallies_.try_emplace({record.plan, record.device}, Tally{.started = started}).first->second;
  if (record.outcome == record::Outcome::measured) {
    ++tally.measured;
  } else {
    ++(record.outcome == record::Outcome::skipped ? tally.skipped : tally.failed);
  }
  tally.ended = last_;
  ++done_;
}

std::string ProgressLog::line_for(const Step& step) {
  if (step.record == nullptr) return {};
  const record::Record& record = *step.record;
  const bool failure = is_failure(record);
  const int failed = tallies_.at({record.plan, record.device}).failed;
  if (!options_.verbose && (!failure || failed > max_failures_per_device)) return {};
  return core::printable(fmt::format("{}/{} {} {}: {}", step.done, step.total, record.device,
                                     record::short_name(record), outcome_of(record))) +
         "\n";
}

std::string ProgressLog::bar(const Step& step) const {
  const std::chrono::seconds left = time_left(step);
  const std::string number =
      has_several_plans()
          ? fmt::format("plan {}/{} ", number_of_plan(step.plan), options_.planned.size())
          : std::string();
  const std::string text =
      fmt::format("{}{} {}/{} {}{}", number,
                  bar_of(step.plan, step.done, step.total, has_several_plans() ? 10 : 20),
                  step.done, step.total, step.device,
                  left.count() > 0 ? ", " + rounded_duration(left) + " left" : std::string());
  return fitted(text);
}

// Returns a line for a log to which nothing was written for a while.
std::string ProgressLog::progress_line(const Step& step) const {
  std::string text = fmt::format("{}: {} of {}", step.plan, step.done, step.total);
  if (has_several_plans()) {
    text +=
        fmt::format("; all {} plans: {} of {}", options_.planned.size(), done_, planned_in_all());
  }
  const std::chrono::seconds left = time_left(step);
  if (left.count() > 0) text += ", about " + rounded_duration(left) + " left";
  return core::printable(text) + "\n";
}

// Shortens the bar so that the last column stays empty. Some terminals wrap a line that fills the
// last column, and a wrapped line cannot be erased.
std::string ProgressLog::fitted(std::string_view text) const {
  return core::printable(core::printable(text), options_.width > 1 ? options_.width - 1 : 1);
}

std::string ProgressLog::summaries() {
  std::string text;
  for (const auto& [where, tally] : tallies_) {
    const auto& [plan, device] = where;
    const auto took = std::chrono::duration_cast<std::chrono::seconds>(tally.ended - tally.started);
    text += core::printable(fmt::format("{} on {}: {} measured, {} skipped, {} failed, {}", plan,
                                        device, tally.measured, tally.skipped, tally.failed,
                                        rounded_duration(took))) +
            "\n";
  }
  tallies_.clear();
  return text;
}

std::string ProgressLog::next(const Step& step) {
  std::string text;
  if (plan_ != step.plan) {
    text = summaries();
    plan_ = step.plan;
    if (step.record == nullptr) last_ = options_.now();
  }
  if (step.record != nullptr) count(*step.record);
  text += line_for(step);
  if (options_.width > 0) return std::string(clear_line) + text + bar(step);
  if (!text.empty()) {
    heartbeat_.restart();
  } else if (heartbeat_.due()) {
    text = progress_line(step);
  }
  return text;
}

std::string ProgressLog::loading(std::string_view data, double share) {
  const std::string text = fmt::format("loading {}: {:.0f} %", data, 100 * share);
  if (options_.width > 0) {
    return std::string(clear_line) + (share < 1 ? fitted(text) : std::string());
  }
  return heartbeat_.due() ? core::printable(text) + "\n" : std::string();
}

ShareLog::ShareLog(ProgressLog::Options options)
    : options_(std::move(options)), started_(options_.now()), last_(started_) {}

std::string ShareLog::next(std::string_view what, double share) {
  const auto now = options_.now();
  if (share <= 0) {
    started_ = now;
    last_ = now;
    return {};
  }
  const bool is_shown = std::exchange(shown_, shown_ && share < 1);
  if (share >= 1) return is_shown && options_.width > 0 ? std::string(clear_line) : std::string();
  // A terminal is updated once a second. A log gets a line when the work has taken as long as
  // `first_log_line`, and then each time that the duration has doubled.
  constexpr auto terminal_interval = std::chrono::seconds(1);
  constexpr auto first_log_line = std::chrono::seconds(10);
  const bool terminal = options_.width > 0;
  const auto since = now - last_;
  if (since < (terminal ? ProgressLog::Clock::duration(terminal_interval)
                        : std::max<ProgressLog::Clock::duration>(first_log_line, last_ - started_)))
    return {};
  last_ = now;
  shown_ = true;
  const auto left =
      std::chrono::duration_cast<std::chrono::seconds>((now - started_) * ((1 - share) / share));
  const std::string time_left = rounded_duration(left + std::chrono::seconds(1));
  if (!terminal) {
    return core::printable(
               fmt::format("{}: {:.0f} %, about {} left", what, 100 * share, time_left)) +
           "\n";
  }
  return std::string(clear_line) +
         core::printable(
             fmt::format("{} {:.0f} %, {} left", bar_of(what, static_cast<int>(100 * share), 100),
                         100 * share, time_left),
             options_.width > 1 ? options_.width - 1 : 1);
}

std::string ProgressLog::end() {
  const std::string text = summaries();
  return options_.width > 0 ? std::string(clear_line) + text : text;
}

}  // namespace triptych::report
