// Tests the sentences about the clocks of times.

#include "report/words/clocks.hpp"

#include <gmock/gmock.h>

namespace triptych::report::words {
namespace {

using testing::HasSubstr;
using testing::Not;

record::ClockTrust clock_trust(const std::string& work, bool offered, bool trusted) {
  return {.work = work, .offered = offered, .trusted = trusted, .verdict = {}};
}

TEST(Clocks, TrustIsSummarized) {
  EXPECT_EQ(trust_of({}), "none");
  EXPECT_EQ(trust_of({clock_trust("compute", false, false)}), "none");
  EXPECT_EQ(trust_of({clock_trust("compute", true, true), clock_trust("draw", true, true)}),
            "trusted");
  EXPECT_EQ(trust_of({clock_trust("compute", true, false), clock_trust("draw", true, false)}),
            "not trusted");
  EXPECT_EQ(trust_of({clock_trust("compute", true, true), clock_trust("draw", true, false)}),
            "trusted for compute only");
}

TEST(Clocks, OneClockIsNamed) {
  const std::string text = clocks_of("gl:x", {{"device", 20}}, {{"device", 3}});
  EXPECT_THAT(text, HasSubstr("gl:x"));
  EXPECT_THAT(text, HasSubstr("the device clock"));
  EXPECT_THAT(text, Not(HasSubstr("wall")));
}

TEST(Clocks, AMixtureAndAChangeAreReported) {
  const std::string mixed = clocks_of("gl:x", {{"device", 19}, {"wall", 1}}, {});
  EXPECT_THAT(mixed, HasSubstr("19"));
  EXPECT_THAT(mixed, HasSubstr("wall"));
  EXPECT_THAT(mixed, Not(HasSubstr("previous")));
  EXPECT_THAT(clocks_of("gl:x", {{"wall", 20}}, {{"device", 20}}), HasSubstr("previous run"));
}

}  // namespace
}  // namespace triptych::report::words
