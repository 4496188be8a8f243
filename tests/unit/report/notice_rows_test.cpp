// Tests the rows of the overview that do not belong to a check.

#include <gmock/gmock.h>

#include <algorithm>

#include "findings.hpp"
#include "report/overview.hpp"
#include "report/words/check.hpp"

namespace triptych::report {
namespace {

using judge::Check;
using judge::GateResult;
using testing::HasSubstr;
using enum judge::Verdict;

void add_notice(GateResult& result, Check check, judge::Verdict verdict, const std::string& device,
                const judge::Observation& what) {
  result.findings.push_back(finding_of(check, verdict, device, "", what));
}

GateResult with_one_image() {
  GateResult result{.plan = "volume/quick", .run = "r", .findings = {}};
  result.findings.push_back(finding_of(Check::image, pass, "gl:x", "step=1", within_bound()));
  result.devices.insert("gl:x");
  return result;
}

// A fault of the device as a whole must not look like a wrong image.
TEST(NoticeRows, FaultsOfADeviceHaveTheirOwnRow) {
  GateResult result = with_one_image();
  add_notice(result, Check::image, regression, "gl:x",
             {.cause = judge::Cause::device_fault, .facts = {{"kind", "memory_grows"}}});
  const Overview all = overview(std::vector{result});
  const auto row = [&](std::string_view topic) {
    return *std::ranges::find(all.rows, topic, &CheckRow::topic);
  };
  EXPECT_EQ(row("image").worst, pass);
  EXPECT_EQ(row("driver").worst, regression);
  EXPECT_THAT(row("driver").sentence, HasSubstr("gl:x"));
  EXPECT_EQ(all.code, core::ExitCode::regression);
  EXPECT_TRUE(std::ranges::none_of(
      overview(std::vector{with_one_image()}).rows,
      [](const CheckRow& each) { return each.topic == "driver" || each.topic == "baselines"; }));
}

TEST(NoticeRows, ChecksThatNeedBaselinesStateWhyTheyWereNotMade) {
  GateResult result = with_one_image();
  add_notice(result, Check::image, cannot_judge, "",
             {.cause = judge::Cause::no_baselines, .names = {"counters"}});
  const Overview all = overview(std::vector{result});
  const auto row = [&](std::string_view topic) {
    return *std::ranges::find(all.rows, topic, &CheckRow::topic);
  };
  EXPECT_EQ(row("image").worst, pass);
  EXPECT_EQ(row("baselines").worst, cannot_judge);
  EXPECT_EQ(row("counters").sentence, words::nothing_to_compare);
  EXPECT_NE(row("cost").sentence, words::nothing_to_compare);
}

}  // namespace
}  // namespace triptych::report
