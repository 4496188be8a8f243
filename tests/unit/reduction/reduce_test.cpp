// Reduces configurations of the volume suite that fail according to a known rule.

#include "reduction/reduce.hpp"

#include <gmock/gmock.h>

#include "measure/contract/factor.hpp"
#include "measure/plan/plan.hpp"
#include "suites/volume/suite.hpp"

namespace triptych::reduction {
namespace {

using measure::Configuration;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::IsEmpty;

const Failure wrong{.cause = judge::Cause::pixels_over_bound};

class Reduce : public testing::Test {
 protected:
  [[nodiscard]] Configuration configuration(const measure::Overrides& overrides) const {
    return measure::default_plan(*suite, overrides).configurations.front();
  }
  // Reduces `start`. A configuration fails if and only if `fails` returns true for it, and all
  // failures are of the same kind.
  [[nodiscard]] Reduction reduce_from(const Configuration& start,
                                      const std::function<bool(const Configuration&)>& fails,
                                      int most_frames = 1000) const {
    const Attempt attempt = [&](const Configuration& each) -> std::optional<Failure> {
      if (!fails(each)) return std::nullopt;
      return wrong;
    };
    return reduce(*suite, start, wrong, most_frames, attempt, [](const Step&) {});
  }

  std::unique_ptr<measure::SuiteWithTruth> suite = volume_suite::make_suite({});
};

int width(const Configuration& configuration) {
  return measure::parse_viewport(configuration.at("viewport"))[0];
}

TEST_F(Reduce, AConstantFailureIsReducedToTheSmallestFrame) {
  const Reduction result =
      reduce_from(configuration({{"step", {"0.5"}}, {"shading", {"gradient"}}}),
                  [](const Configuration&) { return true; });
  EXPECT_EQ(result.smallest, configuration({{"data", {"generate:mandelbulb:1"}},
                                            {"viewport", {"1"}},
                                            {"skip", {"none"}},
                                            {"ert", {"0"}}}));
  EXPECT_TRUE(result.complete);
}

TEST_F(Reduce, LevelsThatTheFaultNeedsAreKept) {
  const Reduction result = reduce_from(
      configuration({{"step", {"0.5"}}, {"viewport", {"200"}}}), [](const Configuration& each) {
        return each.at("skip") == "distance" && each.at("step") == "0.5" && width(each) >= 37;
      });
  EXPECT_EQ(result.smallest, configuration({{"data", {"generate:mandelbulb:1"}},
                                            {"viewport", {"37x1"}},
                                            {"step", {"0.5"}},
                                            {"skip", {"distance"}},
                                            {"ert", {"0"}}}));
}

// Some factors can be simplified only after another factor has been simplified.
TEST_F(Reduce, FactorsAreTriedAgainAfterOthersWereSimplified) {
  const Reduction result = reduce_from(
      configuration({{"adapt", {"0.1"}}, {"skip", {"bricks"}}}), [](const Configuration& each) {
        return each.at("skip") == "bricks" || each.at("adapt") == "0";
      });
  EXPECT_EQ(result.smallest.at("adapt"), "0");
  EXPECT_EQ(result.smallest.at("skip"), "none");
}

TEST_F(Reduce, AnotherKindOfFailureDoesNotCount) {
  const Configuration start = configuration({});
  const Attempt attempt = [](const Configuration&) {
    return Failure{.cause = judge::Cause::ended, .outcome = record::Outcome::crashed};
  };
  const Reduction result = reduce(*suite, start, wrong, 1000, attempt, [](const Step&) {});
  EXPECT_EQ(result.smallest, start);
  EXPECT_THAT(result.steps, IsEmpty());
}

TEST_F(Reduce, NoFrameIsDrawnTwiceAndNoneBeyondTheLimit) {
  std::map<Configuration, int> drawn;
  const auto fails = [&](const Configuration& each) {
    EXPECT_EQ(++drawn[each], 1);
    return width(each) >= 37;
  };
  const Reduction whole = reduce_from(configuration({}), fails);
  EXPECT_EQ(whole.frames, std::ssize(drawn));
  drawn.clear();
  const Reduction part = reduce_from(configuration({}), fails, 5);
  EXPECT_EQ(part.frames, 5);
  EXPECT_FALSE(part.complete);
}

TEST_F(Reduce, ChangesContainFirstAndLastLevels) {
  const Configuration start = configuration({});
  const Configuration smallest = configuration({{"skip", {"none"}}, {"viewport", {"1"}}});
  EXPECT_THAT(changed_levels(*suite, start, smallest),
              ElementsAre(Field(&Step::factor, "skip"), Field(&Step::factor, "viewport")));
}

}  // namespace
}  // namespace triptych::reduction
