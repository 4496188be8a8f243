// Compares spheres drawn by every technique with the reference image, and tests that options for
// how particles are drawn do not change the image.

#include "scene/particles.hpp"

#include <algorithm>
#include <limits>

#include "core/random.hpp"
#include "data_folder.hpp"
#include "particle_scenes.hpp"
#include "suites/particles/stress_cases.hpp"

namespace triptych::contract {
namespace {

using technique::Culling;

void expect_all_true(measure::Device& device, const ParticleWork& work) {
  const reference::SphereTruth truth = truth_of(work);
  with_every_technique(
      device, work, [&](const measure::Work& whole) { expect_true(draw(device, whole), truth); });
}

struct View {
  std::string name;
  std::vector<std::array<double, 4>> spheres;
  scene::Camera camera;
};

// Returns views of a sphere of radius 1 at the origin with a small neighbour, from all kinds of
// positions in which common sprite methods lose pixels.
std::vector<View> difficult_views() {
  const std::vector<std::array<double, 4>> spheres{{0, 0, 0, 1}, {1.2, 0.3, 0.1, 0.2}};
  const glm::dvec3 side = glm::normalize(glm::dvec3{1, 0.5, 2});
  std::vector<View> views;
  for (const double distance : {1.0001, 1.25, 2.0, 1e5}) {
    const double fov =
        distance > 1e3 ? 4 / distance * 180 / 3.14159265358979 : (distance > 1.5 ? 75 : 120);
    views.push_back({fmt::format("at {} radii", distance), spheres,
                     camera_looking_at(distance * side, {0, 0, 0}, fov)});
  }
  views.push_back({"inside", spheres, camera_looking_at({0.3, 0.2, 0.1}, {1, 0.4, -2}, 90)});
  views.push_back(
      {"across the eye's plane", spheres, camera_looking_at({0, 0, 1.3}, {2, 0.3, 1.3}, 100)});
  views.push_back(
      {"centre behind the eye", spheres, camera_looking_at({1.05, 0, 0.2}, {1.3, 0.1, 1.2}, 150)});
  views.push_back(
      {"at the edge of the screen", spheres, camera_looking_at({0, 0, 5}, {2.4, 1.9, 0}, 60)});
  views.push_back({"150 degrees", spheres, camera_looking_at({0.4, 0.2, 2}, {1, 1, 0}, 150)});
  views.push_back({"all behind", spheres, camera_looking_at({0, 0, 3}, {0, 0, 5}, 60)});
  views.push_back({"a neighbour of 10000 radii",
                   {{0, 0, 0, 1}, {0, -10001, 0, 10000}, {2.5, 0, -1, 1}},
                   camera_looking_at({1, 2, 7}, {0, 0, 0}, 60)});
  views.push_back({"a hundredth of a pixel",
                   {{0, 0, 0, 1e-4}, {0.5, 0.1, 0, 1e-4}, {-0.3, 0.2, 0.2, 0.4}},
                   camera_looking_at({0, 0, 2}, {0, 0, 0}, 60)});
  return views;
}

TEST(Particles, NoViewLosesAPixel) {
  on_every_driver([](measure::Device& device) {
    for (const View& view : difficult_views()) {
      SCOPED_TRACE(view.name);
      expect_all_true(device, particle_work(particles_of(view.spheres), view.camera, 97, 83));
    }
  });
}

TEST(Particles, EveryStructureIsTrue) {
  on_every_driver([](measure::Device& device) {
    for (const scene::GeneratorInfo& generator : scene::particle_generators()) {
      for (const char* camera : {"orbit_y:1/8", "path_z:7/8", "random:3"}) {
        SCOPED_TRACE(std::string(generator.name) + " " + camera);
        expect_all_true(device, generated_work(generator.name, 3000, camera, 128));
      }
    }
  });
}

TEST(Particles, ColoursAreCorrectWhereverTheyAreLookedUp) {
  on_every_driver([](measure::Device& device) {
    for (const auto colour :
         {scene::ColourKind::rgba8, scene::ColourKind::rgba32, scene::ColourKind::intensity}) {
      for (const auto stage : {technique::ComputedAt::vertex, technique::ComputedAt::pixel}) {
        SCOPED_TRACE(std::string(scene::name_of(colour)) + " " +
                     std::string(technique::name_of(stage)));
        ParticleWork work = generated_work("uniform", 500, "orbit_y:1/8", 64, colour);
        work.options.transfer = stage;
        expect_all_true(device, work);
      }
    }
  });
}

TEST(Particles, RaysComputedAtVerticesAreCorrect) {
  on_every_driver([](measure::Device& device) {
    for (const View& view : difficult_views()) {
      SCOPED_TRACE(view.name);
      ParticleWork work = particle_work(particles_of(view.spheres), view.camera, 97, 83);
      work.options.ray = technique::ComputedAt::vertex;
      expect_all_true(device, work);
    }
    // Tests many small sprites, because snapping to the rasterizer's grid distorts them the most.
    // With ray=vertex, rays are interpolated linearly between the corners of each triangle. If the
    // interpolation of one triangle were used outside that triangle, the error would exceed the
    // bound here.
    ParticleWork many_small =
        generated_work("uniform", 4000, "orbit_y:1/8", 160, scene::ColourKind::intensity);
    many_small.options.ray = technique::ComputedAt::vertex;
    expect_all_true(device, many_small);
  });
}

// Techniques, culling and conservative depth determine how the image is drawn, but must not change
// it. Eight spheres coincide at each position, so all of these must also select the same sphere
// among equal depths.
TEST(Particles, AllTechniquesAndOptionsAreBitIdentical) {
  on_every_driver([](measure::Device& device) {
    for (const char* camera : {"orbit_y:1/8", "path_z:7/8"}) {
      SCOPED_TRACE(camera);
      const ParticleWork plain = generated_work("coincident", 8000, camera, 96);
      std::optional<core::Image> first;
      with_every_technique(device, plain, [&](const measure::Work& whole) {
        for (const Culling culling : {Culling::none, Culling::frustum, Culling::occlusion}) {
          for (const bool conservative : {false, true}) {
            SCOPED_TRACE(std::string(technique::name_of(culling)) +
                         (conservative ? " conservative" : ""));
            measure::Work work = whole;
            auto& options = std::get<ParticleWork>(work.scene).options;
            options.culling = culling;
            options.conservative_depth = conservative;
            options.corners = 5;
            const auto prepared = device.prepare(work);
            // Compares the third frame, because occlusion culling depends on the previous frame.
            for (int frame = 0; frame < 3; ++frame) {
              static_cast<void>(prepared->frame(measure::Purpose::timing));
            }
            const core::Image image = prepared->image();
            if (!first) first = image;
            EXPECT_EQ(image.ids, first->ids);
            EXPECT_EQ(image.depth, first->depth);
            EXPECT_EQ(image.rgba, first->rgba);
          }
        }
      });
    }
  });
}

// If a hierarchy is rebuilt or refitted in every frame, rays must find the same spheres as in a
// hierarchy that is built once.
TEST(Particles, StructuresBuiltInEveryFrameAreBitIdentical) {
  using technique::Structure;
  on_every_driver([](measure::Device& device) {
    const ParticleWork plain = generated_work("coincident", 8000, "path_z:7/8", 96);
    std::optional<core::Image> first;
    for (const Structure structure :
         {Structure::built_once, Structure::refitted, Structure::rebuilt}) {
      SCOPED_TRACE(technique::name_of(structure));
      ParticleWork work = plain;
      work.options.structure = structure;
      with_every_technique(device, work, [&](const measure::Work& whole) {
        const auto prepared = device.prepare(whole);
        for (int frame = 0; frame < 3; ++frame) {
          static_cast<void>(prepared->frame(measure::Purpose::timing));
        }
        if (!first) first = prepared->image();
        EXPECT_EQ(prepared->image(), *first);
      });
    }
  });
}

// All spheres on one pixel have the same depth, so none of them occludes the others, and there are
// more nodes than one dispatch may visit on llvmpipe and lavapipe.
TEST(Particles, ABeamThroughManyEqualSpheresFindsTheFirst) {
  on_every_driver([](measure::Device& device) {
    std::vector<std::array<double, 4>> spheres(60000, {0, 0, 0, 1});
    const ParticleWork work =
        particle_work(particles_of(spheres), camera_looking_at({0, 0, 5}, {0, 0, 0}, 60), 8, 8);
    for (const char* technique : {"bvh"}) {
      SCOPED_TRACE(technique);
      const measure::Work whole{.technique = technique, .scene = work};
      if (device.unsupported(whole)) continue;
      const core::Image image = draw(device, whole);
      for (const std::uint32_t id : image.ids) {
        EXPECT_TRUE(id == 0 || id == core::Image::no_particle) << id;
      }
    }
  });
}

TEST(Particles, TheOrderInTheFileDoesNotMatter) {
  on_every_driver([](measure::Device& device) {
    const ParticleWork work = generated_work("coincident", 3000, "orbit_y:1/8", 64);
    scene::ParticleSet shuffled = *work.scene.particles;
    core::Random random(5);
    for (std::size_t i = shuffled.count() - 1; i > 0; --i) {
      const std::size_t j = random.bits() % (i + 1);
      std::swap(shuffled.spheres[i], shuffled.spheres[j]);
      std::swap(shuffled.ids[i], shuffled.ids[j]);
      std::swap(shuffled.rgba8[i], shuffled.rgba8[j]);
    }
    ParticleWork other = work;
    other.scene.particles = std::make_shared<const scene::ParticleSet>(std::move(shuffled));
    with_every_technique(device, work, [&](const measure::Work& whole) {
      EXPECT_EQ(draw(device, whole), draw(device, {.technique = whole.technique, .scene = other}));
    });
  });
}

TEST(Particles, AnyNumberOfParticlesIsDrawn) {
  on_every_driver([](measure::Device& device) {
    for (const std::uint64_t count : {1U, 63U, 64U, 65U, 511U, 513U}) {
      SCOPED_TRACE(count);
      expect_all_true(device, generated_work("uniform", count, "orbit_y:1/8", 33));
    }
    SCOPED_TRACE("none");
    expect_all_true(device, particle_work({}, camera_looking_at({0, 0, 3}, {0, 0, 0}, 60), 33, 17));
  });
}

TEST(Particles, EveryImageShapeIsDrawn) {
  on_every_driver([](measure::Device& device) {
    for (const auto& [width, height] :
         std::vector<std::pair<int, int>>{{1, 1}, {1, 40}, {40, 1}, {17, 13}, {130, 65}}) {
      SCOPED_TRACE(fmt::format("{}x{}", width, height));
      ParticleWork work = generated_work("uniform", 2000, "orbit_y:1/8", 8);
      work.scene.width = width;
      work.scene.height = height;
      expect_all_true(device, work);
    }
  });
}

TEST(Particles, RepeatedFramesAreBitIdentical) {
  on_every_driver([](measure::Device& device) {
    const ParticleWork work = generated_work("plume", 5000, "orbit_y:1/8", 64);
    with_every_technique(device, work, [&](const measure::Work& whole) {
      const auto prepared = device.prepare(whole);
      static_cast<void>(prepared->frame(measure::Purpose::timing));
      const core::Image first = prepared->image();
      for (int i = 0; i < 99; ++i) {
        static_cast<void>(prepared->frame(measure::Purpose::timing));
        ASSERT_EQ(prepared->image(), first) << "frame " << i;
      }
    });
  });
}

ParticleWork camera_jump_work() {
  using namespace particles_suite;
  StressScene jump = stress_scene(*stress_data("stress:jump"), scene::ColourKind::rgba8);
  ParticleWork work =
      particle_work(std::move(jump.particles), jump.camera, jump.width, jump.height);
  work.options.culling = Culling::occlusion;
  work.camera_before = jump.camera_before;
  return work;
}

// In the first frame after the jump, the stored set of hidden cells is completely wrong.
TEST(Particles, ACameraJumpLeavesNothingStale) {
  const ParticleWork work = camera_jump_work();
  on_every_driver([&](measure::Device& device) { expect_all_true(device, work); });
}

// Counts must describe the state into which frames settle, no matter how many frames were drawn
// before.
TEST(Particles, CountsAfterACameraJumpAreThoseOfLaterFrames) {
  const ParticleWork work = camera_jump_work();
  on_every_driver([&](measure::Device& device) {
    with_every_technique(device, work, [&](const measure::Work& whole) {
      const auto counted_after = [&](int frames) {
        const auto prepared = device.prepare(whole);
        for (int n = 0; n < frames; ++n) {
          static_cast<void>(prepared->frame(measure::Purpose::timing));
        }
        return prepared->frame(measure::Purpose::counters).counts;
      };
      EXPECT_EQ(counted_after(0), counted_after(4));
    });
  });
}

// The image is larger than textures and points may be. A device must either draw it correctly, or
// reject it with a reason that contains the requested size.
TEST(Particles, AnImageBeyondTheLimitsIsRejectedOrDrawn) {
  on_every_driver([](measure::Device& device) {
    const scene::Camera camera = camera_looking_at({0, 0, 3}, {0, 0, 0}, 0.005);
    const auto work_of_width = [&](int width) {
      return particle_work(particles_of({{0, 0, 0, 1}, {1.1, 0, 0.1, 0.3}}), camera, width, 8);
    };
    const ParticleWork work = work_of_width(131072);
    const ParticleWork narrow = work_of_width(8);
    const reference::SphereTruth truth = truth_of(work);
    for (const std::string& technique : particle_techniques()) {
      SCOPED_TRACE(technique);
      const measure::Work whole{.technique = technique, .scene = work};
      const auto reason = device.unsupported(whole);
      if (!reason) {
        expect_true(draw(device, whole), truth);
      } else if (!device.unsupported({.technique = technique, .scene = narrow})) {
        EXPECT_NE(reason->find("131072x8"), std::string::npos) << *reason;
      }
    }
  });
}

// Invalid particles must be dropped without affecting their neighbours.
TEST(Particles, InvalidSpheresAreDropped) {
  const double nan = std::nan("");
  const double inf = std::numeric_limits<double>::infinity();
  const scene::ParticleSet set = particles_of({{0, 0, 0, 1},
                                               {0, 0, 0.5, 0},
                                               {0, 0, 0.5, -1},
                                               {0, 0, 0.5, nan},
                                               {0, 0, 0.5, inf},
                                               {nan, 0, 0.5, 1},
                                               {1, 0, 0.5, 0.7}});
  EXPECT_EQ(set.dropped, 5U);
  EXPECT_EQ(set.ids, (std::vector<std::uint32_t>{0, 6}));
  on_every_driver([&](measure::Device& device) {
    expect_all_true(device,
                    particle_work(set, camera_looking_at({0, 0, 4}, {0, 0, 0}, 60), 48, 48));
  });
}

TEST(Particles, RealFilesMatchTheReference) {
  const auto files = real_particles();
  if (files.empty()) GTEST_SKIP() << "TRIPTYCH_DATA names no folder with particles/";
  on_every_driver([&](measure::Device& device) {
    for (const auto& file : files) {
      SCOPED_TRACE(file.filename().string());
      scene::ParticleSet set = scene::load_particles(file.string(), scene::ColourKind::rgba8);
      const scene::Camera camera = scene::particle_camera("orbit_y:1/8", set, 60);
      expect_all_true(device, particle_work(std::move(set), camera, 160, 160));
    }
  });
}

}  // namespace
}  // namespace triptych::contract
