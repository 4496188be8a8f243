// Tests drivers that report frames as finished although they did not draw them.
#include <gmock/gmock.h>

#include "tests/layer/layered.hpp"

namespace triptych::layer {
namespace {

using testing::HasSubstr;

class UndrawnFrames : public LayerTest {
 protected:
  void expect_all_found(std::string_view fault, std::string_view plan) const {
    const test::Result drawn = layered.draw(fault, plan);
    EXPECT_THAT(drawn.output, HasSubstr(" 0 measured")) << fault;
    EXPECT_THAT(drawn.output, HasSubstr("but did not draw it")) << fault;
  }
};

TEST_F(UndrawnFrames, CommandsExecutedOnlyOnceAreFound) {
  for (const char* plan : {"volume", "particles"}) expect_all_found("once_only", plan);
}

TEST_F(UndrawnFrames, AreFoundAmongTimedFrames) {
  const test::Result timed =
      layered.time("once_only", "volume", "--set sampler=manual --set technique=raycast");
  EXPECT_THAT(timed.output, HasSubstr("but did not draw it"));
}

}  // namespace
}  // namespace triptych::layer
