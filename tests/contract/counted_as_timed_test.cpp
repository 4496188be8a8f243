// Device code is compiled twice: as the timed build, and as the counting build, which also counts
// its work. Checks that both builds do the same work. Compares the counters with the number of
// samples that the timed build's image reveals, and the images of the two builds with each other.

#include <cmath>

#include "measure/protocol/injected_fault.hpp"
#include "particle_scenes.hpp"

namespace triptych::contract {
namespace {

using measure::VolumeWork;
using technique::Skip;

constexpr std::array all_skips{Skip::none, Skip::bricks, Skip::distance};

// Makes every table entry red, so that the sum computed by speed_of_light is the number of samples.
scene::TransferFunction reddened(std::string_view name) {
  scene::TransferFunction function = scene::load_transfer_function(name);
  for (auto& entry : function.entries) entry[0] = 1;
  return function;
}

double sum_of_red(const core::Image& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) sum += image.rgba[i];
  return sum;
}

void expect_sum_as_counted(measure::Device& device, measure::Work work) {
  auto& volume = std::get<VolumeWork>(work.scene);
  work.technique = "speed_of_light";
  for (const Skip skip : all_skips) {
    SCOPED_TRACE(technique::name_of(skip));
    volume.options.skip = skip;
    const auto prepared = device.prepare(work);
    static_cast<void>(prepared->frame(measure::Purpose::timing));
    const double sum = sum_of_red(prepared->image());
    const record::Counts counts = prepared->frame(measure::Purpose::counters).counts;
    EXPECT_EQ(static_cast<double>(counts.at("samples")), sum);
  }
}

TEST(CountedAsTimed, SpeedOfLightCountsTheSamplesItSums) {
  on_every_driver([](measure::Device& device) {
    for (const scene::GeneratorInfo& generator : scene::volume_generators()) {
      for (const std::string_view function : scene::transfer_function_presets()) {
        SCOPED_TRACE(std::string(generator.name) + " " + std::string(function));
        scene::VolumeScene scene = small_scene(function);
        scene.transfer_function = reddened(function);
        expect_sum_as_counted(
            device, default_work(device, scene::generate_volume(generator.name, {37, 41, 23}),
                                 std::move(scene)));
      }
    }
  });
}

// Returns a volume with walls that are one voxel thick and perpendicular to the axes.
scene::Volume walls() {
  constexpr int side = 64;
  scene::Volume volume{.name = "walls", .size = {side, side, side}, .range_hi = 255};
  const auto lit = [](int i) { return i == 12 || i == 36 || i == 52; };
  for (int k = 0; k < side; ++k) {
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        volume.voxels.push_back(lit(i) || lit(j) || lit(k) ? std::byte{255} : std::byte{0});
      }
    }
  }
  return volume;
}

// A sample on the face between two bricks belongs to the next brick along the ray if rays walk from
// brick to brick (skip=bricks), and to the brick with the higher index if rays leap over cubes of
// bricks (skip=distance). For rays in the negative direction of an axis, these are two different
// bricks. The timed and the counting build must assign such samples to the same brick.
TEST(CountedAsTimed, SamplesOnBrickFacesAreCountedAsDrawn) {
  on_every_driver([](measure::Device& device) {
    scene::VolumeScene scene = small_scene("surfaces");
    scene.transfer_function = reddened("surfaces");
    for (std::size_t k = 0; k < 256; ++k) scene.transfer_function.entries.at(k)[3] = k < 8 ? 0 : 1;
    scene.width = 1;
    scene.height = 1;
    scene.step_voxels = 16;
    measure::Work work = default_work(device, walls(), std::move(scene));
    for (const glm::dvec3 ahead : {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1)}) {
      for (const double direction : {-1.0, 1.0}) {
        SCOPED_TRACE(ahead.x > 0 ? direction : 3 * direction);
        const glm::dvec3 target(20, 20, 20);
        std::get<VolumeWork>(work.scene).scene.camera =
            scene::camera_looking_at(target - 128 * direction * ahead, target, 60);
        expect_sum_as_counted(device, work);
      }
    }
  });
}

// Derives the number of steps from the image of a volume with a constant opacity per voxel length,
// drawn with early termination. The transmittance of a ray results from a number of whole steps
// and, if the ray did not terminate early, from a partial step.
struct Tally {
  std::uint64_t rays_hit = 0;
  std::uint64_t terminated = 0;
  std::uint64_t samples = 0;
  // rays whose last step has almost no length, so it may not be counted
  std::uint64_t doubtful = 0;
};

Tally tally_of(const core::Image& image, double alpha, double step_voxels, double ert) {
  constexpr double negligible = 1e-3;
  const double per_step = step_voxels * std::log1p(-alpha);
  Tally tally;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
    const double left = 1 - static_cast<double>(image.rgba[i]);
    if (left == 1) continue;
    tally.rays_hit += 1;
    const double steps = std::log(left) / per_step;
    tally.samples += static_cast<std::uint64_t>(std::ceil(steps - negligible));
    if (left < ert) {
      tally.terminated += 1;
    } else if (std::abs(steps - std::round(steps)) < negligible) {
      tally.doubtful += 1;
    }
  }
  return tally;
}

TEST(CountedAsTimed, RaysEndAtTheSameStepInBothBuilds) {
  constexpr double alpha = 0.03125;
  constexpr double ert = 0.6;
  on_every_driver([&](measure::Device& device) {
    scene::VolumeScene scene = small_scene("haze");
    for (auto& entry : scene.transfer_function.entries) entry = {1, 1, 1, alpha};
    measure::Work work =
        default_work(device, scene::generate_volume("uniform_box", {37, 41, 23}), std::move(scene));
    auto& volume = std::get<VolumeWork>(work.scene);
    volume.options.ert = ert;
    for (const char* technique : {"raycast", "raycast_fragment"}) {
      for (const auto rule : {scene::Quadrature::midpoint, scene::Quadrature::preintegrated}) {
        for (const Skip skip : all_skips) {
          SCOPED_TRACE(technique);
          SCOPED_TRACE(technique::name_of(skip));
          work.technique = technique;
          volume.scene.quadrature = rule;
          volume.options.skip = skip;
          if (device.unsupported(work)) continue;
          const auto prepared = device.prepare(work);
          static_cast<void>(prepared->frame(measure::Purpose::timing));
          const Tally tally = tally_of(prepared->image(), alpha, volume.scene.step_voxels, ert);
          const record::Counts counts = prepared->frame(measure::Purpose::counters).counts;
          EXPECT_GT(tally.terminated, 0U);
          EXPECT_LT(tally.terminated, tally.rays_hit);
          EXPECT_LT(tally.doubtful, tally.rays_hit / 50);
          EXPECT_NEAR(static_cast<double>(counts.at("rays_hit")),
                      static_cast<double>(tally.rays_hit), static_cast<double>(tally.doubtful));
          EXPECT_EQ(counts.at("rays_terminated"), tally.terminated);
          EXPECT_NEAR(static_cast<double>(counts.at("samples")), static_cast<double>(tally.samples),
                      static_cast<double>(tally.doubtful));
        }
      }
    }
  });
}

void expect_same_image(measure::Device& device, const measure::Work& work) {
  const auto prepared = device.prepare(work);
  static_cast<void>(prepared->frame(measure::Purpose::timing));
  const core::Image timed = prepared->image();
  static_cast<void>(prepared->frame(measure::Purpose::counters));
  EXPECT_EQ(prepared->image(), timed);
}

TEST(CountedAsTimed, BothBuildsDrawTheSameVolumeImage) {
  on_every_driver([](measure::Device& device) {
    measure::Work work = default_work(device, scene::generate_volume("mandelbulb", {37, 41, 23}),
                                      small_scene("surfaces"));
    for (const char* technique : {"raycast", "raycast_fragment"}) {
      for (const Skip skip : all_skips) {
        for (const double adapt : {0.0, 1.0 / 255}) {
          for (const auto rule : {scene::Quadrature::midpoint, scene::Quadrature::cells}) {
            SCOPED_TRACE(technique);
            work.technique = technique;
            auto& volume = std::get<VolumeWork>(work.scene);
            volume.options.skip = skip;
            volume.options.adapt = adapt;
            volume.scene.quadrature = rule;
            if (!device.unsupported(work)) expect_same_image(device, work);
          }
        }
      }
    }
  });
}

// With the injected fault `wrong_sense`, a shader violates its declaration of conservative depth,
// so the image reveals which fragments were rejected early. The counting build must reject the same
// fragments as the timed build. Images without the fault are compared only in the nightly run
// (is_exhaustive_run()), or if the fault cannot be injected into the technique.
TEST(CountedAsTimed, BothBuildsRejectTheSameFragmentsEarly) {
  on_every_driver([](measure::Device& device) {
    ParticleWork work = studded_wall();
    for (const bool conservative : {false, true}) {
      work.options.conservative_depth = conservative;
      with_every_technique(device, work, [&](const measure::Work& whole) {
        measure::Work faulty = whole;
        measure::inject("wrong_sense", faulty);
        const bool rejects = !device.unsupported(faulty);
        if (rejects) expect_same_image(device, faulty);
        if (is_exhaustive_run() || (conservative && !rejects)) expect_same_image(device, whole);
      });
    }
  });
}

// If a program rejects fragments early in its own code, it does not count the rejected fragments.
TEST(CountedAsTimed, FragmentsRejectedEarlyAreNotCounted) {
  on_every_driver([](measure::Device& device) {
    // With the other APIs, the rasterizer is part of the driver.
    if (device.info().api != "opencl") return;
    ParticleWork work = generated_work("uniform", 20000, "orbit_y:1/8", 96);
    work.scene.radius_scale = 3;
    const auto fragments = [&](bool conservative) {
      work.options.conservative_depth = conservative;
      const measure::Work whole{.technique = "quad_instanced", .scene = work};
      return device.prepare(whole)->frame(measure::Purpose::counters).counts.at("fragments");
    };
    EXPECT_LT(fragments(true), fragments(false));
  });
}

}  // namespace
}  // namespace triptych::contract
