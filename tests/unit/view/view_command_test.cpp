// Tests the command line that the window copies, and the request with which the window is started.

#include "view/view_command.hpp"

#include <gtest/gtest.h>

#include "core/json.hpp"

namespace triptych::view {
namespace {

measure::ViewRequest request() {
  return {.program = "/usr/bin/triptych",
          .suite = "volume",
          .configuration = {{"camera", "view:1/2/3"}, {"step", "0.5"}},
          .devices = {{.id = "gl:x", .api = "gl"}},
          .sides = {{"gl:x", {"A=1", "B=2 3"}}, {"null:y"}},
          .faults = {"half_voxel_shift@gl:*"},
          .limit_s = 60,
          .data_folders = {"/data"},
          .screenshot = "a b.png",
          .json = true};
}

TEST(ViewCommand, HasTheVariablesAndFaultsOfItsColumn) {
  const std::string key = "camera=view:1/2/3,data=a%2Cb.nrrd,technique=raycast";
  EXPECT_EQ(
      render_command(request(), request().sides[0], key),
      "A=1 B='2 3' triptych render volume --device gl:x --set camera=view:1/2/3 --set "
      "data=a%2Cb.nrrd --set technique=raycast --inject half_voxel_shift --truth --out frame");
  EXPECT_EQ(render_command(request(), request().sides[1], key, std::pair(3, 4)),
            "triptych render volume --device null:y --set camera=view:1/2/3 --set "
            "data=a%2Cb.nrrd --set technique=raycast --pixel 3,4 --out frame");
}

TEST(ViewCommand, RepeatsALimitThatIsNotTheUsualOne) {
  measure::ViewRequest slow = request();
  slow.limit_s = 90;
  EXPECT_NE(render_command(slow, slow.sides[1], "technique=raycast").find("--limit 90"),
            std::string::npos);
}

TEST(ViewRequest, RoundTrips) {
  const measure::ViewRequest written = request();
  const auto read = core::Json::parse(core::Json(written).dump()).get<measure::ViewRequest>();
  EXPECT_EQ(core::Json(read), core::Json(written));
  EXPECT_EQ(read.sides, written.sides);
  EXPECT_EQ(read.devices, written.devices);
  EXPECT_EQ(read.configuration, written.configuration);
  EXPECT_EQ(read.width, 1280);
  EXPECT_TRUE(read.json);
}

}  // namespace
}  // namespace triptych::view
