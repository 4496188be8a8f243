// Tests that skipping empty space gives bit-identical images for every real volume and for volumes
// from every generator, the latter with and without shading and with the quadratures `midpoint` and
// `preintegrated`.

#include "data_folder.hpp"
#include "under_test.hpp"

namespace triptych::contract {
namespace {

void expect_same_bits(measure::Device& device, measure::Work work) {
  auto& options = std::get<measure::VolumeWork>(work.scene).options;
  for (const double ert : {0.0, 1.0 / 512}) {
    options.ert = ert;
    options.skip = technique::Skip::none;
    const core::Image without = draw(device, work);
    for (const technique::Skip skip : {technique::Skip::bricks, technique::Skip::distance}) {
      options.skip = skip;
      EXPECT_EQ(draw(device, work), without)
          << "ERT " << ert << ", skip " << technique::name_of(skip);
    }
  }
}

TEST(Skipping, GeneratedVolumesAreBitIdentical) {
  on_every_driver([](measure::Device& device) {
    for (const scene::GeneratorInfo& generator : scene::volume_generators()) {
      for (const std::string_view function : scene::transfer_function_presets()) {
        for (const bool shaded : {false, true}) {
          for (const auto quadrature :
               {scene::Quadrature::midpoint, scene::Quadrature::preintegrated}) {
            SCOPED_TRACE(std::string(generator.name) + " " + std::string(function));
            scene::VolumeScene scene = small_scene(function);
            scene.shading.enabled = shaded;
            scene.quadrature = quadrature;
            expect_same_bits(
                device, default_work(device, scene::generate_volume(generator.name, {37, 41, 23}),
                                     std::move(scene)));
          }
        }
      }
    }
  });
}

TEST(Skipping, RealVolumesAreBitIdentical) {
  const auto files = real_volumes();
  if (files.empty()) GTEST_SKIP() << "TRIPTYCH_DATA names no folder with volumes/";
  on_every_driver([&](measure::Device& device) {
    for (const auto& file : files) {
      const scene::Volume volume = scene::load_volume(file.string());
      for (const std::string_view function : scene::transfer_function_presets()) {
        SCOPED_TRACE(file.filename().string() + " " + std::string(function));
        scene::VolumeScene scene = small_scene(function);
        scene.shading.enabled = function == "surfaces";
        expect_same_bits(device, default_work(device, volume, std::move(scene)));
      }
    }
  });
}

// A perfect method would take exactly the samples with non-zero opacity. Every skip mode must take
// all of these samples. Leaps (skip=distance), which use smaller bricks, must not take more
// additional samples than a walk from brick to brick (skip=bricks).
TEST(Skipping, TakesAllVisibleSamplesAndFewOthers) {
  const auto files = real_volumes();
  if (files.empty()) GTEST_SKIP() << "TRIPTYCH_DATA names no folder with volumes/";
  on_every_driver([&](measure::Device& device) {
    for (const auto& file : files) {
      const scene::Volume volume = scene::load_volume(file.string());
      for (const std::string_view function : scene::transfer_function_presets()) {
        SCOPED_TRACE(file.filename().string() + " " + std::string(function));
        measure::Work work = default_work(device, volume, small_scene(function));
        auto& options = std::get<measure::VolumeWork>(work.scene).options;
        options.ert = 0;
        const auto counts = [&](technique::Skip skip) {
          options.skip = skip;
          return device.prepare(work)->frame(measure::Purpose::counters).counts;
        };
        const auto brute = counts(technique::Skip::none);
        const auto walk = counts(technique::Skip::bricks);
        const auto leaps = counts(technique::Skip::distance);
        EXPECT_EQ(walk.at("samples_nonzero"), brute.at("samples_nonzero"));
        EXPECT_EQ(leaps.at("samples_nonzero"), brute.at("samples_nonzero"));
        EXPECT_LE(leaps.at("samples"), walk.at("samples"));
        EXPECT_LE(walk.at("samples"), brute.at("samples"));
      }
    }
  });
}

}  // namespace
}  // namespace triptych::contract
