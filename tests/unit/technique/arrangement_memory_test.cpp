// Measures how much memory `arrange()` needs, by replacing this program's allocation functions.

#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <memory>
#include <new>

#include "scene/particle_generators.hpp"
#include "technique/particles/arrangement.hpp"

namespace {

// Initialised at compile time, because allocations can happen before main().
constinit std::atomic<std::size_t> allocated_bytes{0};
constinit std::atomic<std::size_t> most_bytes{0};

}  // namespace

// Neither operator may be inlined: if only one of them is, GCC 12 warns that the pair does not
// match.
[[gnu::noinline]] void* operator new(std::size_t size) {
  void* memory = std::malloc(std::max<std::size_t>(size, 1));
  if (memory == nullptr) throw std::bad_alloc();
  const std::size_t allocated = allocated_bytes += ::malloc_usable_size(memory);
  std::size_t most = most_bytes;
  while (allocated > most && !most_bytes.compare_exchange_weak(most, allocated)) {
  }
  return memory;
}

[[gnu::noinline]] void operator delete(void* memory) noexcept {
  allocated_bytes -= ::malloc_usable_size(memory);
  std::free(memory);
}

[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  operator delete(memory);
}

namespace triptych::technique {
namespace {

std::size_t bytes_of(const scene::ParticleSet& set) {
  return set.spheres.size() * 16 + set.ids.size() * 4 + set.rgba8.size() * 4 +
         set.rgba32.size() * 16 + set.intensity.size() * 4;
}

class ArrangementMemory : public testing::TestWithParam<scene::ColourKind> {};

// The only new array is the order of the particles. Another hundredth of the set's size is allowed
// for the cells.
TEST_P(ArrangementMemory, ArrangingTakesFourBytesPerParticle) {
  scene::ParticleScene scene;
  const std::size_t before = allocated_bytes;
  scene.particles = std::make_shared<const scene::ParticleSet>(
      scene::generate_particles("uniform", 400'000, GetParam()));
  scene.camera = scene::particle_camera("orbit_y:1/8", *scene.particles, 60);
  const double set_bytes = static_cast<double>(bytes_of(*scene.particles));
  EXPECT_LT(static_cast<double>(allocated_bytes - before), 1.001 * set_bytes);
  most_bytes = allocated_bytes.load();
  const Arrangement arrangement = arrange(scene);
  EXPECT_EQ(arrangement.count(), scene.particles->count());
  const double order_bytes = 4.0 * static_cast<double>(arrangement.count());
  EXPECT_LT(static_cast<double>(most_bytes - before), 1.01 * set_bytes + order_bytes);
}

INSTANTIATE_TEST_SUITE_P(EveryColour, ArrangementMemory,
                         testing::Values(scene::ColourKind::rgba8, scene::ColourKind::rgba32,
                                         scene::ColourKind::intensity),
                         [](const auto& kind) { return std::string(name_of(kind.param)); });

}  // namespace
}  // namespace triptych::technique
