// Tests which values the window's controls offer, accept and reject.

#include "view/choices.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "measure/plan/plan.hpp"
#include "suites/particles/suite.hpp"
#include "suites/volume/suite.hpp"

namespace triptych::view {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class ViewChoices : public testing::Test {
 protected:
  [[nodiscard]] static Choices choices_of(const measure::Suite& suite) {
    return {suite, measure::default_plan(suite, {}).configurations.front()};
  }
  std::unique_ptr<measure::SuiteWithTruth> volume = volume_suite::make_suite({});
  std::unique_ptr<measure::SuiteWithTruth> particles = particles_suite::make_suite({});
};

TEST_F(ViewChoices, LevelsAreStoredInCanonicalSpelling) {
  Choices choices = choices_of(*volume);
  EXPECT_EQ(choices.set("step", "0.50"), "");
  EXPECT_EQ(choices.value("step"), "0.5");
  EXPECT_THAT(choices.key(), HasSubstr("step=0.5"));
  EXPECT_EQ(choices.set("camera", "view:1/2/3"), "");
  choices.reset();
  EXPECT_EQ(choices.configuration(), measure::default_plan(*volume, {}).configurations.front());
}

TEST_F(ViewChoices, RejectedLevelsChangeNothing) {
  Choices choices = choices_of(*volume);
  const measure::Configuration before = choices.configuration();
  EXPECT_THAT(choices.set("step", "0"), HasSubstr("step"));
  EXPECT_THAT(choices.set("camera", "view:0/100/1"), HasSubstr("elevation"));
  EXPECT_NE(choices.set("camera", "orbit_y:*/8"), "");
  EXPECT_NE(choices.set("technique", "auto"), "");
  EXPECT_THAT(choices.set("data", "nowhere.nrrd"), HasSubstr("nowhere.nrrd"));
  EXPECT_EQ(choices.configuration(), before);
}

// Every value that the window offers must be valid, unless its file is missing.
TEST_F(ViewChoices, EveryOfferIsAccepted) {
  for (const measure::Suite* suite : {static_cast<const measure::Suite*>(volume.get()),
                                      static_cast<const measure::Suite*>(particles.get())}) {
    Choices choices = choices_of(*suite);
    for (const measure::Factor& factor : suite->factors()) {
      const std::vector<std::string>& offered_levels = choices.offered_levels(factor.name);
      EXPECT_THAT(offered_levels, Contains(choices.default_level(factor.name))) << factor.name;
      for (const std::string& add_level : offered_levels) {
        if (factor.name == "data" && add_level.find(':') == std::string::npos) continue;
        EXPECT_EQ(choices.set(factor.name, add_level), "") << factor.name << '=' << add_level;
        choices.reset();
      }
    }
  }
}

TEST_F(ViewChoices, OffersComeFromPlansAndGenerators) {
  const Choices choices = choices_of(*volume);
  EXPECT_THAT(choices.offered_levels("technique"), Not(Contains("auto")));
  EXPECT_THAT(choices.offered_levels("transfer_function"), Contains("surfaces"));
  for (const scene::GeneratorInfo& each : volume->generators()) {
    EXPECT_THAT(choices.offered_levels("data"), Contains(HasSubstr(std::string(each.name))))
        << each.name;
  }
  const std::vector<std::string>& steps = choices.offered_levels("step");
  ASSERT_GT(steps.size(), 2U);
  EXPECT_LT(std::stod(steps[0]), std::stod(steps[1]));
}

}  // namespace
}  // namespace triptych::view
