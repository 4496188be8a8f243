// Tests what measure/contract/backend.hpp requires of every API.

#include <cstdlib>
#include <set>

#include "core/error.hpp"
#include "under_test.hpp"

namespace triptych::contract {
namespace {

measure::Work some_work(const measure::Device& device) {
  return default_work(device, scene::generate_volume("marschner_lobb", {24, 24, 24}),
                      small_scene("haze"));
}

TEST(Contract, ListingTwiceGivesTheSameDevices) {
  const auto backend = backend_under_test();
  const measure::Listing once = backend->list();
  const measure::Listing again = backend->list();
  EXPECT_EQ(once.devices, again.devices);
  std::set<std::string> ids;
  for (const record::Device& device : once.devices) {
    EXPECT_TRUE(ids.insert(device.id).second) << device.id << " is listed twice";
    EXPECT_TRUE(device.id.starts_with(std::string(backend->api()) + ":")) << device.id;
    EXPECT_EQ(device.driver_version.find('\n'), std::string::npos);
  }
}

TEST(Contract, AMissingDeviceIsNotSupported) {
  EXPECT_THROW(static_cast<void>(backend_under_test()->open("none:such")), core::NotSupported);
}

TEST(Contract, FramesAreTimedAndRepeatable) {
  on_every_device([](measure::Device& device) {
    const measure::Work work = some_work(device);
    ASSERT_EQ(device.unsupported(work), std::nullopt);
    const auto prepared = device.prepare(work);
    EXPECT_GT(prepared->frame(measure::Purpose::timing).wall_ns, 0);
    const core::Image first = prepared->image();
    EXPECT_EQ(first.width, 64);
    EXPECT_EQ(first.height, 48);
    for (int i = 0; i < 5; ++i) {
      EXPECT_TRUE(prepared->frame(measure::Purpose::timing).counts.empty());
      EXPECT_EQ(prepared->image(), first) << "frame " << i;
    }
  });
}

TEST(Contract, CountingIsRepeatableAndLeavesTheImageUnchanged) {
  on_every_device([](measure::Device& device) {
    const auto prepared = device.prepare(some_work(device));
    static_cast<void>(prepared->frame(measure::Purpose::timing));
    const core::Image timed = prepared->image();
    const record::Counts counts = prepared->frame(measure::Purpose::counters).counts;
    EXPECT_EQ(prepared->frame(measure::Purpose::counters).counts, counts);
    EXPECT_EQ(prepared->frame(measure::Purpose::statistics).counts,
              prepared->frame(measure::Purpose::statistics).counts);
    static_cast<void>(prepared->frame(measure::Purpose::timing));
    EXPECT_EQ(prepared->image(), timed);
  });
}

TEST(Contract, DifferentDeviceCodeHasADifferentHash) {
  on_every_device([](measure::Device& device) {
    if (device.info().api == "null") GTEST_SKIP() << "scripted devices have no device code";
    measure::Work work = some_work(device);
    const std::string hash = device.prepare(work)->kernel_hash();
    EXPECT_FALSE(hash.empty());
    EXPECT_EQ(device.prepare(work)->kernel_hash(), hash);
    std::get<measure::VolumeWork>(work.scene).scene.shading.enabled = true;
    EXPECT_NE(device.prepare(work)->kernel_hash(), hash);
  });
}

TEST(Contract, AVolumeBeyondEveryLimitIsRejectedWithBothNumbers) {
  on_every_device([](measure::Device& device) {
    if (device.info().api == "null") GTEST_SKIP() << "scripted devices have no limits";
    measure::Work work = some_work(device);
    auto& volume = std::get<measure::VolumeWork>(work.scene);
    scene::VoxelGrid grid = *volume.scene.grid;
    grid.size = {1, 1, 1 << 20};  // never allocated, because the device rejects it first
    volume.scene.grid = std::make_shared<const scene::VoxelGrid>(std::move(grid));
    volume.options.sampler = technique::Sampler::hardware;
    const auto reason = device.unsupported(work);
    ASSERT_NE(reason, std::nullopt);
    EXPECT_NE(reason->find("1048576"), std::string::npos) << *reason;
  });
}

class DriverVariables : public testing::Environment {
 public:
  void SetUp() override {
    // The null backend has devices only if it is given a script.
    ::setenv("TRIPTYCH_NULL_SCRIPT", "{}", 0);
    ::setenv("POCL_PTHREAD_MIN_WGS", "1", 0);
  }
};
[[maybe_unused]] const testing::Environment* const driver_variables =
    testing::AddGlobalTestEnvironment(new DriverVariables);  // GoogleTest deletes it

}  // namespace
}  // namespace triptych::contract
