// Tests frames for timing, for statistics and for counters.
#include <gmock/gmock.h>

#include <chrono>
#include <thread>

#include "backends/opencl/devices.hpp"
#include "backends/opencl/launches.hpp"
#include "core/error.hpp"
#include "technique/portable/prelude.hpp"
#include "technique/volume/bricks.hpp"
#include "technique/volume/raycast_parameters.hpp"
#include "tests/device/opencl/opencl_devices.hpp"

namespace triptych::opencl_backend {
namespace {

using measure::Purpose;
constexpr std::array<std::string_view, 2> techniques{"raycast", "speed_of_light"};

TEST(OpenClFrames, DeviceTimeDoesNotExceedWallTime) {
  for_each_device([](measure::Device& device) {
    for (const std::string_view technique : techniques) {
      const auto prepared = device.prepare(make_work(technique, make_scene({})));
      const measure::Frame frame = prepared->frame(Purpose::timing);
      EXPECT_GT(frame.wall_ns, 0);
      if (frame.device_ns) {
        EXPECT_LE(*frame.device_ns, frame.wall_ns);
      }
      EXPECT_TRUE(frame.counts.empty());
      EXPECT_FALSE(prepared->frame(Purpose::counters).device_ns);
      // OpenCL has no pipeline statistics. They must be absent rather than zero.
      EXPECT_TRUE(prepared->frame(Purpose::statistics).counts.empty());
    }
  });
}

TEST(OpenClFrames, EveryPurposeDrawsTheSameImage) {
  for_each_device([](measure::Device& device) {
    for (const std::string_view technique : techniques) {
      SCOPED_TRACE(technique);
      test::expect_same_image(*device.prepare(make_work(technique, make_scene({.shading = true}))));
    }
  });
}

TEST(OpenClFrames, ExtraWorkLeavesTheImageUnchanged) {
  for_each_device([](measure::Device& device) {
    const scene::VolumeScene scene = make_scene({.width = 200, .height = 200});
    const technique::RaycastOptions options{.skip = technique::Skip::none, .ert = 0};
    const auto plain = device.prepare(make_work("raycast", scene, options));
    technique::RaycastOptions twice = options;
    twice.extra_work_stride = 1;
    const auto slowed = device.prepare(make_work("raycast", scene, twice));
    static_cast<void>(plain->frame(Purpose::timing));
    static_cast<void>(slowed->frame(Purpose::timing));
    EXPECT_EQ(slowed->image(), plain->image());
    EXPECT_EQ(slowed->kernel_hash(), plain->kernel_hash());
  });
}

// The numbers of samples and hits of the scene, computed on the host with the formulas of the
// kernel.
struct Expected {
  std::uint64_t rays_hit = 0;
  std::uint64_t samples = 0;
};

Expected count_on_host(const scene::VolumeScene& scene) {
  namespace portable = technique::portable;
  Expected expected;
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      const glm::dvec3 d = scene.camera.ray_direction(x, y, scene.width, scene.height);
      double near = 0;
      double far = 1e30;
      for (int axis = 0; axis < 3; ++axis) {
        const double a = -scene.camera.eye[axis] / d[axis];
        const double b = (scene.box().hi[axis] - scene.camera.eye[axis]) / d[axis];
        near = std::max(near, std::min(a, b));
        far = std::min(far, std::max(a, b));
      }
      if (far <= near) continue;
      ++expected.rays_hit;
      expected.samples += static_cast<std::uint64_t>(std::ceil((far - near) / scene.step_world()));
    }
  }
  return expected;
}

TEST(OpenClFrames, CountersMatchTheHost) {
  for_each_device([](measure::Device& device) {
    const scene::VolumeScene scene =
        make_scene({.camera = "random:3", .width = 61, .height = 47, .step_voxels = 0.37});
    const Expected expected = count_on_host(scene);
    const technique::RaycastOptions options{.skip = technique::Skip::none, .ert = 0};
    for (const std::string_view technique : techniques) {
      const auto counts =
          device.prepare(make_work(technique, scene, options))->frame(Purpose::counters).counts;
      EXPECT_EQ(counts.at("rays"), 61U * 47U);
      // If the length of a ray is a whole number of steps, apart from round-off, its sample count
      // may differ by one.
      const auto off =
          static_cast<double>(counts.at("samples")) - static_cast<double>(expected.samples);
      EXPECT_LE(std::abs(off), 1e-4 * static_cast<double>(expected.samples));
      EXPECT_NEAR(static_cast<double>(counts.at("rays_hit")),
                  static_cast<double>(expected.rays_hit), 1);
      EXPECT_EQ(counts.at("samples_saved"), 0U);
      EXPECT_EQ(counts.at("bricks_visited"), 0U);
      EXPECT_EQ(counts.at("rays_terminated"), 0U);
    }
  });
}

TEST(OpenClFrames, SamplesTakenAndSavedAddUp) {
  for_each_device([](measure::Device& device) {
    const scene::VolumeScene scene = make_scene({.data = "generate:sparse_field:64"});
    const auto count = [&](technique::Skip skip, double ert) {
      return device.prepare(make_work("raycast", scene, {.skip = skip, .ert = ert}))
          ->frame(Purpose::counters)
          .counts;
    };
    const auto all = count(technique::Skip::none, 0);
    const auto skipped = count(technique::Skip::bricks, 0);
    const auto terminated = count(technique::Skip::none, 1.0 / 512);
    EXPECT_EQ(skipped.at("samples_nonzero"), all.at("samples_nonzero"));
    EXPECT_LT(skipped.at("samples"), all.at("samples") / 2);
    EXPECT_EQ(skipped.at("samples") + skipped.at("samples_saved"), all.at("samples"));
    EXPECT_GT(skipped.at("bricks_skipped"), 0U);
    EXPECT_GT(skipped.at("bricks_visited"), skipped.at("bricks_skipped"));
    EXPECT_GT(terminated.at("rays_terminated"), 0U);
    EXPECT_LT(terminated.at("samples"), all.at("samples"));
    EXPECT_EQ(terminated.at("samples") + terminated.at("samples_saved"), all.at("samples"));
  });
}

TEST(OpenClFrames, TheHashCoversOnlyTheDeviceCode) {
  for_each_device([](measure::Device& device) {
    const auto hash = [&](const SceneOptions& scene, const technique::RaycastOptions& options) {
      return device.prepare(make_work("raycast", make_scene(scene), options))->kernel_hash();
    };
    const std::string plain = hash({}, {});
    EXPECT_EQ(plain, hash({.camera = "random:1", .width = 20}, {.ert = 0}));
    const std::string walk = hash({}, {.skip = technique::Skip::bricks});
    EXPECT_EQ(walk, hash({}, {.skip = technique::Skip::none}));
    EXPECT_NE(walk, plain);
    EXPECT_NE(plain, hash({.shading = true}, {}));
    EXPECT_NE(plain, hash({.voxel = scene::VoxelFormat::u8}, {}));
    EXPECT_NE(plain, hash({}, {.fault = technique::Fault::flipped_axis}));
  });
}

TEST(OpenClFrames, UnsupportedWorkIsNotPrepared) {
  for_each_device([](measure::Device& device) {
    EXPECT_THROW(static_cast<void>(device.prepare(make_work("no_such_technique", make_scene({})))),
                 core::NotSupported);
  });
}

// The host pauses between two commands while the device's clock continues.
TEST(OpenClFrames, TimeBetweenLaunchesIsIncluded) {
  constexpr std::chrono::milliseconds pause{20};
  constexpr double pause_ns = std::chrono::duration<double, std::nano>(pause).count();
  for (const Found& each : find_devices().found) {
    const cl::Context context(each.device);
    const cl::CommandQueue queue(context, each.device, CL_QUEUE_PROFILING_ENABLE);
    const cl::Buffer buffer(context, CL_MEM_READ_WRITE, 64);
    FrameRun run;
    const auto device_ns = [&](std::size_t commands) {
      const auto enqueue = [&](std::vector<cl::Event>& events) {
        events.assign(commands, {});
        for (cl::Event& event : events) {
          queue.enqueueFillBuffer(buffer, cl_uint{1}, 0, 64, nullptr, &event);
          queue.finish();
          std::this_thread::sleep_for(pause);
        }
      };
      return run.draw(measure::Purpose::timing, enqueue).device_ns;
    };
    const auto alone = device_ns(1);
    if (!alone || *alone == 0) continue;  // the device reports no times
    EXPECT_GE(device_ns(2).value_or(0), pause_ns) << each.info.id;
  }
}

}  // namespace
}  // namespace triptych::opencl_backend
