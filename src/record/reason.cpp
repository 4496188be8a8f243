#include "record/reason.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "record/names.hpp"

namespace triptych::record {
namespace {

constexpr Names<Outcome, 6> outcome_names{{
    {Outcome::measured, "measured"},
    {Outcome::skipped, "skipped"},
    {Outcome::failed, "failed"},
    {Outcome::crashed, "crashed"},
    {Outcome::hung, "hung"},
    {Outcome::lost, "lost"},
}};

constexpr Names<Cause, 19> cause_names{{
    {Cause::none, "none"},
    {Cause::same_frames, "same_frames"},
    {Cause::not_supported, "not_supported"},
    {Cause::bad_input, "bad_input"},
    {Cause::no_emulator, "no_emulator"},
    {Cause::not_on_processor, "not_on_processor"},
    {Cause::api_error, "api_error"},
    {Cause::device_lost, "device_lost"},
    {Cause::not_drawn, "not_drawn"},
    {Cause::out_of_memory, "out_of_memory"},
    {Cause::error, "error"},
    {Cause::signal, "signal"},
    {Cause::exit_code, "exit_code"},
    {Cause::unknown_end, "unknown_end"},
    {Cause::timeout, "timeout"},
    {Cause::bad_answer, "bad_answer"},
    {Cause::no_greeting, "no_greeting"},
    {Cause::cannot_start, "cannot_start"},
    {Cause::under_way, "under_way"},
}};

constexpr Names<Stage, 3> stage_names{{
    {Stage::working, "working"},
    {Stage::opening, "opening"},
    {Stage::counting, "counting"},
}};

}  // namespace

std::string_view name_of(Outcome outcome) {
  return name_in(outcome_names, outcome);
}
Outcome outcome(std::string_view name) {
  return value_named(outcome_names, "outcome", name);
}
std::string_view name_of(Cause cause) {
  return name_in(cause_names, cause);
}
Cause cause(std::string_view name) {
  return value_named(cause_names, "cause", name);
}
std::string_view name_of(Stage stage) {
  return name_in(stage_names, stage);
}
Stage stage(std::string_view name) {
  return value_named(stage_names, "stage", name);
}

std::optional<double> Reason::number(const std::string& name) const {
  const auto found = numbers.find(name);
  return found == numbers.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::chrono::seconds> Reason::limit() const {
  const auto limit_s = number("limit_s");
  if (cause != Cause::timeout || !limit_s || !(*limit_s > 0 && *limit_s < 1e6)) return std::nullopt;
  return std::chrono::seconds(std::lround(std::ceil(*limit_s)));
}

std::string kind_of(const Reason& reason) {
  const bool api = reason.cause == Cause::api_error || reason.cause == Cause::device_lost;
  return fmt::format("{} {} {} {} {}", name_of(reason.cause), name_of(reason.stage),
                     reason.number("signal").value_or(-1), reason.number("exit_code").value_or(-1),
                     api ? reason.subject + " " + reason.code : "");
}

bool lacks_data(Outcome outcome, const Reason& reason) {
  return outcome == Outcome::skipped && reason.cause == Cause::not_supported &&
         !reason.subject.empty();
}

bool is_same_kind(const Reason& a, const Reason& b) {
  return kind_of(a) == kind_of(b);
}

NotMeasured::NotMeasured(Outcome outcome, Reason reason)
    : Error(fmt::format("{}: {}", name_of(outcome), name_of(reason.cause))),
      outcome_(outcome),
      reason_(std::move(reason)) {}

core::ExitCode NotMeasured::exit_code() const noexcept {
  const bool lacking = outcome_ == Outcome::skipped && reason_.cause != Cause::bad_input;
  return lacking ? core::ExitCode::cannot_judge : core::ExitCode::usage;
}

}  // namespace triptych::record
