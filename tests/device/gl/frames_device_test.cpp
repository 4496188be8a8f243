// Tests frames for timing, for statistics and for counters.
#include <gmock/gmock.h>

#include <set>

#include "core/error.hpp"
#include "technique/volume/raycast_parameters.hpp"
#include "tests/device/gl/gl_devices.hpp"

namespace triptych::gl_backend {
namespace {

using measure::Purpose;

constexpr std::array<std::string_view, 3> techniques{"raycast", "raycast_fragment",
                                                     "speed_of_light"};

TEST(GlFrames, DeviceTimeDoesNotExceedWallTime) {
  for_each_device([](measure::Device& device) {
    for (const std::string_view technique : techniques) {
      const auto prepared = device.prepare(make_work(technique, make_scene({})));
      const measure::Frame frame = prepared->frame(Purpose::timing);
      EXPECT_GT(frame.wall_ns, 0);
      if (frame.device_ns) {
        EXPECT_LE(*frame.device_ns, frame.wall_ns);
      }
      EXPECT_TRUE(frame.counts.empty());
      EXPECT_FALSE(prepared->frame(Purpose::statistics).device_ns);
      EXPECT_FALSE(prepared->frame(Purpose::counters).device_ns);
    }
  });
}

TEST(GlFrames, EveryPurposeDrawsTheSameImage) {
  for_each_device([](measure::Device& device) {
    for (const std::string_view technique : techniques) {
      SCOPED_TRACE(technique);
      test::expect_same_image(*device.prepare(make_work(technique, make_scene({}))));
    }
  });
}

TEST(GlFrames, CountersAddUp) {
  for_each_device([](measure::Device& device) {
    for (const std::string_view technique : image_techniques) {
      const scene::VolumeScene scene = make_scene({});
      const auto count = [&](technique::Skip skip, double ert) {
        technique::RaycastOptions options;
        options.skip = skip;
        options.ert = ert;
        return device.prepare(make_work(technique, scene, options))
            ->frame(Purpose::counters)
            .counts;
      };
      record::Counts brute = count(technique::Skip::none, 0);
      record::Counts skipping = count(technique::Skip::bricks, 0);
      record::Counts ending = count(technique::Skip::bricks, 1.0 / 512);
      ASSERT_EQ(brute.size(), technique::raycast_counters.size() + 1);
      EXPECT_EQ(brute["rays"], 33U * 29U);
      EXPECT_GT(brute["rays_hit"], 0U);
      EXPECT_LT(brute["rays_hit"], brute["rays"]);
      EXPECT_EQ(brute["samples_saved"], 0U);
      EXPECT_EQ(brute["bricks_visited"], 0U);
      EXPECT_EQ(brute["rays_terminated"], 0U);

      EXPECT_EQ(skipping["samples"] + skipping["samples_saved"], brute["samples"]);
      EXPECT_EQ(skipping["samples_nonzero"], brute["samples_nonzero"]);
      EXPECT_GT(skipping["bricks_skipped"], 0U);
      EXPECT_LT(skipping["samples"], brute["samples"]);

      EXPECT_GT(ending["rays_terminated"], 0U);
      EXPECT_LT(ending["samples"], skipping["samples"]);
      EXPECT_EQ(ending["samples"] + ending["samples_saved"], brute["samples"]);
    }
  });
}

TEST(GlFrames, StatisticsCoverExactlyTheStagesInUse) {
  for_each_device([](measure::Device& device) {
    for (const std::string_view technique : techniques) {
      auto counts =
          device.prepare(make_work(technique, make_scene({})))->frame(Purpose::statistics).counts;
      EXPECT_FALSE(counts.contains("geometry_invocations"));
      if (technique == "raycast_fragment") {
        EXPECT_FALSE(counts.contains("compute_invocations"));
        if (counts.contains("input_assembly_vertices")) {
          EXPECT_EQ(counts["input_assembly_vertices"], 3U);
          EXPECT_EQ(counts["input_assembly_primitives"], 1U);
        }
        if (counts.contains("fragment_invocations")) {
          EXPECT_GE(counts["fragment_invocations"], 33U * 29U);
        }
      } else {
        EXPECT_FALSE(counts.contains("vertex_invocations"));
        // Work groups of 8×8 are always complete, so invocations outside of the image count too.
        // softpipe 22.3.6 counts work groups instead of invocations.
        if (counts.contains("compute_invocations")) {
          const bool groups = device.info().driver == "softpipe";
          EXPECT_EQ(counts["compute_invocations"], groups ? 5U * 4U : 40U * 32U);
        }
      }
    }
  });
}

TEST(GlFrames, ExtraWorkIsDoneAndLeavesTheImageUnchanged) {
  for_each_device([](measure::Device& device) {
    for (const std::string_view technique : techniques) {
      const scene::VolumeScene scene = make_scene({});
      const auto plain = device.prepare(make_work(technique, scene));
      technique::RaycastOptions options;
      options.extra_work_stride = 3;
      const auto more = device.prepare(make_work(technique, scene, options));
      static_cast<void>(plain->frame(Purpose::timing));
      static_cast<void>(more->frame(Purpose::timing));
      EXPECT_EQ(plain->image(), more->image()) << technique;
      EXPECT_EQ(plain->kernel_hash(), more->kernel_hash());

      auto without = plain->frame(Purpose::statistics).counts;
      auto with = more->frame(Purpose::statistics).counts;
      for (const char* name : {"compute_invocations", "fragment_invocations"}) {
        if (without.contains(name)) {
          EXPECT_GT(with[name], without[name]) << technique;
        }
      }
    }
  });
}

TEST(GlFrames, SeveralPreparedWorksCanAlternate) {
  for_each_device([](measure::Device& device) {
    for (const std::string_view technique : techniques) {
      const auto a = device.prepare(make_work(technique, make_scene({})));
      const auto b =
          device.prepare(make_work(technique, make_scene({.data = "generate:frequency_box:24",
                                                          .transfer_function = "haze",
                                                          .voxel = scene::VoxelFormat::u16,
                                                          .width = 20,
                                                          .height = 20})));
      static_cast<void>(a->frame(Purpose::timing));
      const core::Image first = a->image();
      static_cast<void>(b->frame(Purpose::timing));
      EXPECT_NE(b->image(), first);
      static_cast<void>(a->frame(Purpose::timing));
      EXPECT_EQ(a->image(), first);
    }
  });
}

TEST(GlFrames, TheKernelHashDistinguishesBuilds) {
  for_each_device([](measure::Device& device) {
    std::set<std::string> hashes;
    const auto add = [&](std::string_view technique, const technique::RaycastOptions& options) {
      const auto hash =
          device.prepare(make_work(technique, make_scene({}), options))->kernel_hash();
      EXPECT_EQ(hash, device.prepare(make_work(technique, make_scene({}), options))->kernel_hash());
      hashes.insert(hash);
    };
    add("raycast", {});
    add("raycast", {.sampler = technique::Sampler::hardware});
    add("raycast", {.fault = technique::Fault::coarse_filter});
    add("raycast_fragment", {});
    add("speed_of_light", {});
    EXPECT_EQ(hashes.size(), 5U);
    add("raycast", {.skip = technique::Skip::bricks});
    EXPECT_EQ(hashes.size(), 6U);
    // Options that are switched at run time need no additional build.
    add("raycast", {.skip = technique::Skip::none, .ert = 0});
    EXPECT_EQ(hashes.size(), 6U);
  });
}

}  // namespace
}  // namespace triptych::gl_backend
