// Tests the results of frames other than images: times, counters and pipeline statistics.
#include <gmock/gmock.h>

#include <cstdint>
#include <cstdlib>

#include "core/error.hpp"
#include "tests/device/vulkan/vulkan_devices.hpp"

namespace triptych::vulkan_backend {
namespace {

using measure::Purpose;
using technique::Skip;

record::Counts counters(measure::Device& device, std::string_view technique,
                        const scene::VolumeScene& scene, const technique::RaycastOptions& options) {
  return device.prepare(make_work(technique, scene, options))->frame(Purpose::counters).counts;
}

// Counts the samples of every ray in double precision.
struct Lattice {
  std::uint64_t rays_hit = 0;
  std::uint64_t samples = 0;
};
Lattice count_lattice(const scene::VolumeScene& scene) {
  const scene::Box box = scene.box();
  Lattice lattice;
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      const glm::dvec3 d = scene.camera.ray_direction(x, y, scene.width, scene.height);
      double enter = 0;
      double leave = 1e300;
      for (int axis = 0; axis < 3; ++axis) {
        const double a = (box.lo[axis] - scene.camera.eye[axis]) / d[axis];
        const double b = (box.hi[axis] - scene.camera.eye[axis]) / d[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
      }
      if (!(leave > enter)) continue;
      ++lattice.rays_hit;
      lattice.samples +=
          static_cast<std::uint64_t>(std::ceil((leave - enter) / scene.step_world()));
    }
  }
  return lattice;
}

TEST(VulkanFrames, CountersMatchTheHost) {
  for_each_device([](measure::Device& device) {
    const scene::VolumeScene scene = make_scene({.camera = "random:4", .step_voxels = 0.3});
    const Lattice expected = count_lattice(scene);
    for (const std::string_view technique : image_techniques) {
      const record::Counts counts =
          counters(device, technique, scene, {.skip = Skip::none, .ert = 0});
      EXPECT_EQ(counts.at("rays"),
                static_cast<std::uint64_t>(scene.width) * static_cast<std::uint64_t>(scene.height));
      EXPECT_EQ(counts.at("rays_hit"), expected.rays_hit);
      // If the length of a ray is a whole number of steps, apart from round-off, the ray may take
      // one more sample.
      EXPECT_NEAR(static_cast<double>(counts.at("samples")), static_cast<double>(expected.samples),
                  1e-4 * static_cast<double>(expected.samples));
      EXPECT_EQ(counts.at("bricks_visited"), 0U);
      EXPECT_EQ(counts.at("samples_saved"), 0U);
      EXPECT_EQ(counts.at("rays_terminated"), 0U);
    }
  });
}

TEST(VulkanFrames, OnlyInvisibleSamplesAreSkipped) {
  for_each_device([](measure::Device& device) {
    const scene::VolumeScene scene = make_scene({.data = "generate:sparse_field:48"});
    for (const std::string_view technique : image_techniques) {
      const auto brute = counters(device, technique, scene, {.skip = Skip::none, .ert = 0});
      const auto skipped = counters(device, technique, scene, {.skip = Skip::bricks, .ert = 0});
      EXPECT_EQ(skipped.at("samples") + skipped.at("samples_saved"), brute.at("samples"));
      EXPECT_EQ(skipped.at("samples_nonzero"), brute.at("samples_nonzero"));
      EXPECT_LT(skipped.at("samples"), brute.at("samples"));
      EXPECT_GT(skipped.at("bricks_skipped"), 0U);
      EXPECT_GT(skipped.at("bricks_visited"), skipped.at("bricks_skipped"));
      const auto ended = counters(device, technique, scene, {.ert = 0.02});
      EXPECT_GT(ended.at("rays_terminated"), 0U);
      EXPECT_LT(ended.at("samples"), skipped.at("samples"));
    }
  });
}

TEST(VulkanFrames, ComputeAndFragmentCountEqually) {
  for_each_device([](measure::Device& device) {
    const scene::VolumeScene scene = make_scene({.data = "generate:nested_shells:40"});
    EXPECT_EQ(counters(device, "raycast", scene, {}),
              counters(device, "raycast_fragment", scene, {}));
  });
}

TEST(VulkanFrames, StatisticsAreExactAndRepeatable) {
  for_each_device([](measure::Device& device) {
    if (device.info().limits.at("pipelineStatisticsQuery") == "no") GTEST_SKIP();
    const auto compute = device.prepare(make_work("raycast", make_scene()));
    const auto draw = device.prepare(make_work("raycast_fragment", make_scene()));
    std::uint64_t fragments = 0;
    for (int repeat = 0; repeat < 3; ++repeat) {
      const record::Counts compute_counts = compute->frame(Purpose::statistics).counts;
      // An image of 33×29 pixels has 5×4 tiles of 8×8 pixels.
      EXPECT_EQ(compute_counts, (record::Counts{{"compute_invocations", 5U * 4U * 64U}}));
      const record::Counts draw_counts = draw->frame(Purpose::statistics).counts;
      EXPECT_EQ(draw_counts.at("input_assembly_vertices"), 3U);
      EXPECT_EQ(draw_counts.at("input_assembly_primitives"), 1U);
      EXPECT_EQ(draw_counts.at("vertex_invocations"), 3U);
      EXPECT_EQ(draw_counts.at("clipping_invocations"), 1U);
      EXPECT_GE(draw_counts.at("clipping_primitives"), 1U);
      // The number of fragment invocations depends on how the driver counts, which the gate judges
      // separately. For this image of 33×29 = 957 pixels, lavapipe from Mesa 25.0.7 counts exactly
      // one invocation for each pixel, whereas lavapipe from Mesa 22.3 also counts helper
      // invocations.
      EXPECT_GT(draw_counts.at("fragment_invocations"), 0U);
      if (repeat == 0) fragments = draw_counts.at("fragment_invocations");
      EXPECT_EQ(draw_counts.at("fragment_invocations"), fragments);
      EXPECT_FALSE(draw_counts.contains("compute_invocations"));
      EXPECT_FALSE(draw_counts.contains("geometry_invocations"));
    }
  });
}

TEST(VulkanFrames, OnlyTimedFramesHaveTimes) {
  for_each_device([](measure::Device& device) {
    for (const std::string_view technique : {"raycast", "raycast_fragment", "speed_of_light"}) {
      const auto prepared = device.prepare(make_work(technique, make_scene()));
      const measure::Frame timed = prepared->frame(Purpose::timing);
      EXPECT_GT(timed.wall_ns, 0);
      EXPECT_GE(timed.device_ns.value_or(0), 0);
      EXPECT_TRUE(timed.counts.empty());
      EXPECT_FALSE(prepared->frame(Purpose::statistics).device_ns);
      EXPECT_FALSE(prepared->frame(Purpose::counters).device_ns);
    }
  });
}

TEST(VulkanFrames, DeviceTimeCoversTheWholeRenderPass) {
  for_each_device([](measure::Device& device) {
    const auto prepared =
        device.prepare(make_work("raycast_fragment", make_scene({.width = 256, .height = 256})));
    static_cast<void>(prepared->frame(Purpose::timing));  // the first frame compiles shaders
    // Takes the best of several frames, because a busy machine may wake up the thread late.
    double share_of_wall = 0;
    for (int i = 0; i < 20; ++i) {
      const measure::Frame frame = prepared->frame(Purpose::timing);
      if (!frame.device_ns) GTEST_SKIP() << "the device has no clock";
      EXPECT_LE(*frame.device_ns, frame.wall_ns);
      share_of_wall = std::max(share_of_wall, *frame.device_ns / frame.wall_ns);
    }
    EXPECT_GE(share_of_wall, device.info().driver == "llvmpipe" ? 0.5 : 0);
  });
}

TEST(VulkanFrames, PurposeAndExtraWorkLeaveTheImageUnchanged) {
  for_each_device([](measure::Device& device) {
    for (const std::string_view technique : image_techniques) {
      const core::Image plain = draw_image(device, make_work(technique, make_scene()));
      for (const int stride : {1, 3, 33, 1000}) {
        const auto prepared =
            device.prepare(make_work(technique, make_scene(), {.extra_work_stride = stride}));
        for (const Purpose purpose : {Purpose::timing, Purpose::statistics, Purpose::counters}) {
          static_cast<void>(prepared->frame(purpose));
          EXPECT_EQ(prepared->image(), plain) << technique << " stride " << stride;
        }
      }
    }
  });
}

TEST(VulkanFrames, ExtraWorkIsDone) {
  for_each_device([](measure::Device& device) {
    if (device.info().limits.at("pipelineStatisticsQuery") == "no") GTEST_SKIP();
    const auto prepared =
        device.prepare(make_work("raycast", make_scene(), {.extra_work_stride = 2}));
    // The image has 4 rows of 3 tiles of 16×8 pixels, each of which takes 2 work groups of 64
    // invocations. To draw half of the tiles again, 2 more tiles are dispatched in each row.
    EXPECT_EQ(prepared->frame(Purpose::statistics).counts.at("compute_invocations"),
              2U * (3U + 2U) * 4U * 64U);
    const auto drawn =
        device.prepare(make_work("raycast_fragment", make_scene(), {.extra_work_stride = 2}));
    EXPECT_GT(drawn->frame(Purpose::statistics).counts.at("input_assembly_vertices"), 3U);
  });
}

TEST(VulkanFrames, TheHashCoversOnlyTheDeviceCode) {
  for_each_device([](measure::Device& device) {
    const auto hash = [&](std::string_view technique, const scene::VolumeScene& scene,
                          const technique::RaycastOptions& options = {}) {
      return device.prepare(make_work(technique, scene, options))->kernel_hash();
    };
    const std::string base = hash("raycast", make_scene());
    EXPECT_EQ(hash("raycast", make_scene({.camera = "random:1"}), {.ert = 0}), base);
    const std::string walk = hash("raycast", make_scene(), {.skip = Skip::bricks});
    EXPECT_EQ(hash("raycast", make_scene(), {.skip = Skip::none}), walk);
    EXPECT_NE(walk, base);
    EXPECT_NE(hash("raycast_fragment", make_scene()), base);
    EXPECT_NE(hash("speed_of_light", make_scene()), base);
    EXPECT_NE(hash("raycast", make_scene({.shading = true})), base);
    EXPECT_NE(hash("raycast", make_scene({.step_voxels = 0.5})), base);
    EXPECT_NE(hash("raycast", make_scene(), {.sampler = technique::Sampler::hardware}), base);
    EXPECT_NE(hash("raycast", make_scene(), {.fault = technique::Fault::flipped_axis}), base);
  });
}

}  // namespace
}  // namespace triptych::vulkan_backend
