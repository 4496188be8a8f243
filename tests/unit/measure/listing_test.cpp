#include "measure/worker/listing.hpp"

#include <gmock/gmock.h>

#include "core/error.hpp"

namespace triptych::measure {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Listing some_listing() {
  Listing listing;
  for (const char* id : {"opencl:pocl", "gl:llvmpipe", "gl:softpipe"}) {
    listing.devices.push_back({.id = id});
  }
  listing.broken.push_back({.what = "Vulkan", .reason = "no loader"});
  return listing;
}

std::string refusal(const Listing& listing, const std::string& glob) {
  try {
    static_cast<void>(choose_devices(listing, {"gl:*", glob}));
  } catch (const core::NotSupported& error) {
    return error.what();
  }
  return "none";
}

TEST(ApisOf, ContainsOnlyApisThatAGlobMayMatch) {
  const std::vector<std::string> all{"gl", "opencl", "vulkan"};
  EXPECT_EQ(apis_of({}, all), all);
  EXPECT_EQ(apis_of({"*"}, all), all);
  EXPECT_EQ(apis_of({"*:llvmpipe*"}, all), all);
  EXPECT_THAT(apis_of({"gl:llvmpipe-egl"}, all), ElementsAre("gl"));
  EXPECT_THAT(apis_of({"vulkan:*", "o*"}, all), ElementsAre("opencl", "vulkan"));
  // No device can match, so all APIs are opened, and the error message can list all devices.
  EXPECT_EQ(apis_of({"metal:*"}, all), all);
}

TEST(ChooseDevices, InTheOrderOfTheListing) {
  EXPECT_EQ(choose_devices(some_listing(), {}).size(), 3U);
  EXPECT_THAT(choose_devices(some_listing(), {"*softpipe", "opencl:*", "gl:s*"}),
              ElementsAre("opencl:pocl", "gl:softpipe"));
}

// If a glob matches nothing, all APIs are opened, so that the error message can list all devices.
// Devices that only compile are not listed like other devices.
TEST(Unmatched, ContainsGlobsWithoutADevice) {
  EXPECT_THAT(unmatched(some_listing(), {"gl:*", "vulkan", "opencl:pocl"}), ElementsAre("vulkan"));
  EXPECT_TRUE(unmatched(some_listing(), {"vulkan:radv-navi31"}).empty());
  EXPECT_TRUE(unmatched(some_listing(), {}).empty());
}

TEST(ChooseDevices, EachGlobMustMatchADevice) {
  EXPECT_EQ(refusal(some_listing(), "vulkan:*"),
            "no device matches vulkan:*; available devices: opencl:pocl gl:llvmpipe gl:softpipe; "
            "Vulkan: no loader");
  EXPECT_THAT(refusal({}, "*"), HasSubstr("no installed driver provides"));
  // If every device is missing, the error states the reasons that the drivers reported.
  EXPECT_THAT(refusal({.devices = {}, .broken = some_listing().broken}, "*"),
              HasSubstr("Vulkan: no loader"));
}

// The gate must read a glob in the same way. Otherwise it would not know which devices were
// requested, and could not report those that are missing.
TEST(ChooseDevices, OnlyAsterisksAndQuestionMarksAreSpecial) {
  EXPECT_THAT(choose_devices(some_listing(), {"gl:?oftp*"}), ElementsAre("gl:softpipe"));
  for (const std::string glob : {"gl:[s]*", "gl:s\\*"}) {
    EXPECT_THAT(refusal(some_listing(), glob), HasSubstr("no device matches " + glob));
    EXPECT_FALSE((record::RunStart{.requested = {glob}}.requests_device("gl:softpipe"))) << glob;
  }
}

TEST(ChooseDevice, RequiresExactlyOneDevice) {
  EXPECT_EQ(choose_device(some_listing(), "--against", "gl:s*"), "gl:softpipe");
  EXPECT_THROW(static_cast<void>(choose_device(some_listing(), "--against", "gl:*")),
               core::InputError);
}

}  // namespace
}  // namespace triptych::measure
