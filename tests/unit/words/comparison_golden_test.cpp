// Compares the sentences that Triptych writes about comparisons with golden files (see golden.hpp).

#include <fmt/format.h>

#include "findings.hpp"
#include "golden.hpp"
#include "report/words/code.hpp"
#include "report/words/comparison.hpp"

namespace triptych::report {
namespace {

using comparison::Difference;
using comparison::DifferenceCause;
using comparison::TimeCause;
using comparison::WallClockCause;

// Returns a difference with every number and name that a sentence may contain.
Difference everything(DifferenceCause cause) {
  Difference what{.cause = cause};
  what.side = measure::Side::b;
  what.numbers = {{"pixels", 12},  {"total", 4096},  {"x", 3},        {"y", 4},
                  {"error", 0.25}, {"rmse", 0.0125}, {"particles", 1}};
  what.facts = {{"a", "1024"}, {"b", "2048"}};
  what.changes = {
      {.name = "device_code", .unit = judge::Unit::instructions, .before = 1000, .now = 1100}};
  what.sides = {ended(record::Outcome::failed, {.cause = record::Cause::error, .detail = "DETAIL"}),
                crashed(11)};
  if (cause == DifferenceCause::reported_by_one_side) what.changes[0].before.reset();
  if (cause == DifferenceCause::wrong_image) what.sides = {std::nullopt, over_bound(16)};
  what.worths = {
      record::StatisticWorth{},
      record::StatisticWorth{.worth = record::Worth::inflated, .low = 1.25, .high = 3.5}};
  what.code = judge::CodeComparison{};
  what.code->changes = {
      {"raycast.comp", "Subgroups per SIMD", judge::code_statistic("Subgroups per SIMD"), 16, 12},
      {"raycast.comp", "VGPRs", judge::code_statistic("VGPRs"), 84, 100},
      {"raycast.comp", "Inverse Throughput", judge::code_statistic("Inverse Throughput"), 332,
       368}};
  what.total = judge::CodeTotal{.before = 1971,
                                .now = 1964,
                                .less = 10,
                                .more = 3,
                                .helped = 1,
                                .hurt = 1,
                                .worst = "step=1",
                                .worst_before = 657,
                                .worst_now = 660};
  return what;
}

TEST(ComparisonSentences, OfEveryDifference) {
  std::string text;
  for_each_value<DifferenceCause>([&](DifferenceCause cause) {
    const std::string sentence = words::text_of(everything(cause));
    EXPECT_NE(sentence, "") << name_of(cause);
    text += fmt::format("{}: {}\n", name_of(cause), sentence);
  });
  Difference of_one_side = everything(DifferenceCause::limit_changed);
  of_one_side.facts.erase("a");
  text += fmt::format("limit of b: {}\n", words::text_of(of_one_side));
  of_one_side.facts = {{"a", "1024"}};
  of_one_side.injected = "crash";
  text += fmt::format("limit of a: {}\n", words::text_of(of_one_side));
  expect_golden("differences.txt", text);
}

TEST(ComparisonSentences, OfGroups) {
  comparison::DifferenceGroup group{.difference = everything(DifferenceCause::same_driver),
                                    .where = "step=1"};
  std::string text;
  for (const int count : {1, 12}) {
    group.count = count;
    text += words::text_of(group) + "\n";
    group.ratios = {0.9, 1.1};
    text += words::text_of(group) + "\n";
    group.ratios.reset();
  }
  group.ratios = {1.05, 21.7};
  text += words::text_of(group) + "\n";
  expect_golden("groups.txt", text);
}

TEST(ComparisonSentences, OfEveryReasonForNoTime) {
  std::string text;
  for_each_value<TimeCause>([&](TimeCause cause) {
    const comparison::TimeReason reason{
        .cause = cause,
        .side = measure::Side::b,
        .outcome = record::Outcome::crashed,
        .reason = {.cause = record::Cause::signal, .numbers = {{"signal", 11}}},
        .suspected = comparison::PairVerdict::slower,
        .numbers = {{"ratio", 1.05}, {"process_runs", 10}, {"blocks", 384}, {"most", 0.03}}};
    text += fmt::format("{}: {}\n", name_of(cause), words::text_of(reason));
  });
  for_each_value<WallClockCause>([&](WallClockCause cause) {
    text += fmt::format("{}: {}\n", name_of(cause), words::text_of(cause));
  });
  text += words::nothing_compared({}) + "\n";
  text += words::text_of(comparison::OneSidedEntry{.plan = "volume/quick", .device = {}}) + "\n";
  text +=
      words::text_of(comparison::OneSidedEntry{.plan = "volume/quick", .device = "gl:x"}) + "\n";
  text += words::fails_differently(over_bound(16), crashed(11)) + "\n";
  text += words::fails_differently(over_bound(16), {}) + "\n";
  expect_golden("no_time.txt", text);
}

TEST(ComparisonSentences, AboutAllConfigurationsAndTheLoad) {
  comparison::OverallTime time{.decided = 1, .undecided = 2, .averaged = 3};
  time.shift = {0.01, {-0.05, 0.07}};
  std::string text = words::overall(time) + "\n";
  time.shift = {0.06, {0.05, 0.07}};
  text += words::overall(time) + "\n" + words::load(0.04) + "\n" + words::load(4.6) + "\n";
  text += words::when_undecided("") + "\n" + words::when_undecided("COMMAND") + "\n";
  comparison::ComparisonResult result;
  result.b = {.driver = "llvmpipe", .driver_version = "Mesa 1", .api_version = "1.3"};
  result.ineffective_variables = {"LD_LIBRARY_PATH", "VK_DRIVER_FILES"};
  text += words::same_driver(result);
  comparison::SideBySide table{.unit = "ns", .clock = "wall", .devices = {}, .rows = {}};
  text += words::uncertainty(table) + "\n";
  table.process_runs = 5;
  text += words::uncertainty(table) + "\n";
  expect_golden("compared_sides.txt", text);
}

}  // namespace
}  // namespace triptych::report
