// How much noise may leave open before a run cannot be judged.

#include <gmock/gmock.h>

#include <algorithm>
#include <array>

#include "correlation_fixture.hpp"

namespace triptych::judge {
namespace {

using core::ExitCode;
using testing::HasSubstr;

// 48 configurations of one device with its own history.
class OpenTimesTest : public CorrelationGateTest {
 protected:
  OpenTimesTest() { request_.checks = {Check::timing}; }

  // Whether it is among the first so many.
  static bool is_among(const record::Record& record, std::size_t first) {
    const std::array<std::string, 3> configurations{"data=d0,step=0,technique=raycast",
                                                    "data=d1,step=2,technique=raycast_fragment",
                                                    "data=d2,step=4,technique=raycast"};
    return std::find(configurations.begin(), configurations.begin() + first,
                     record.configuration) != configurations.begin() + first;
  }

  // A history in which `wild` configurations are longer by up to a third in every other
  // run, and one more run in which they take `factor` times as long as at best.
  GateResult after_wild_history(std::size_t wild, double factor) {
    for (int i = 0; i < 6; ++i) {
      const double longer = i % 2 == 0 ? 1 : 1.33;
      const std::string id = fmt::format("b:new {} plan", i);
      measure(id, "b:new",
              [&](const record::Record& record) { return is_among(record, wild) ? longer : 1; });
      accept_plan(id, plan);
    }
    measure("x", "b:new",
            [&](const record::Record& record) { return is_among(record, wild) ? factor : 1; });
    return judge("x");
  }
};

TEST_F(OpenTimesTest, AFewAreAdviceAndSayHowToSettleThem) {
  const GateResult result = after_wild_history(2, 1.15);
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  const auto advice = with(result, Verdict::advisory);
  ASSERT_EQ(advice.size(), 2U) << text(result);
  EXPECT_THAT(advice[0].message, HasSubstr("too much scatter"));
  EXPECT_THAT(advice[0].message, HasSubstr("settle it with triptych compare volume/correlation"));
}

// 3 of 48 are more than a twentieth.
TEST_F(OpenTimesTest, MoreThanAFewCannotBeJudged) {
  const GateResult result = after_wild_history(3, 1.15);
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge) << text(result);
  EXPECT_EQ(with(result, Verdict::cannot_judge).size(), 3U) << text(result);
}

TEST_F(OpenTimesTest, OneThatCameOutSlowerByAFifthIsNotExcused) {
  const GateResult result = after_wild_history(1, 1.6);
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge) << text(result);
  EXPECT_EQ(with(result, Verdict::cannot_judge).size(), 1U) << text(result);
}

}  // namespace
}  // namespace triptych::judge
