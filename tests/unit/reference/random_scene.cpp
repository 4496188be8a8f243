#include "random_scene.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <utility>

#include "core/random.hpp"

namespace triptych::reference {

std::shared_ptr<const scene::VoxelGrid> make_grid(
    const std::array<int, 3>& size, const std::array<double, 3>& spacing, scene::VoxelFormat format,
    const std::function<double(int, int, int)>& value) {
  scene::Volume volume;
  volume.name = "test";
  volume.size = size;
  volume.spacing = spacing;
  volume.type = scene::ScalarType::f32;
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        const auto bytes =
            std::bit_cast<std::array<std::byte, sizeof(float)>>(static_cast<float>(value(i, j, k)));
        volume.voxels.insert(volume.voxels.end(), bytes.begin(), bytes.end());
      }
    }
  }
  return std::make_shared<const scene::VoxelGrid>(scene::encode(std::move(volume), format));
}

scene::Camera look_at(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up,
                      double fov_y_deg) {
  scene::Camera camera;
  camera.eye = eye;
  camera.forward = glm::normalize(target - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(camera.forward, up));
  camera.up = glm::cross(right, camera.forward);
  camera.fov_y_deg = fov_y_deg;
  return camera;
}

scene::TransferFunction constant_table(const std::array<float, 4>& rgba) {
  scene::TransferFunction function;
  function.entries.fill(rgba);
  return function;
}

namespace {

scene::TransferFunction rough_table(core::Random& random) {
  scene::TransferFunction function;
  for (auto& entry : function.entries) {
    for (float& channel : entry) channel = static_cast<float>(random.uniform());
    const double kind = random.uniform();
    entry[3] *= 0.2F;
    if (kind < 0.5) entry[3] = 0.0F;
    if (kind > 0.95) entry[3] = 1.0F;
    if (kind > 0.98) entry[3] = 1.0F - 0x1.0p-24F;
  }
  return function;
}

scene::TransferFunction smooth_table(core::Random& random) {
  scene::TransferFunction function;
  const double phase = random.uniform(0, 6);
  const double opacity = random.uniform(0.02, 0.15);
  for (std::size_t k = 0; k < function.entries.size(); ++k) {
    const double x = static_cast<double>(k) / 255.0;
    function.entries[k] = {static_cast<float>(0.5 + 0.5 * std::sin(3 * x + phase)),
                           static_cast<float>(x), static_cast<float>(1 - 0.7 * x),
                           static_cast<float>(opacity * std::max(x - 0.2, 0.0))};
  }
  return function;
}

}  // namespace

scene::VolumeScene random_scene(std::uint64_t seed, Character character,
                                scene::VoxelFormat format) {
  core::Random random(seed);
  scene::VolumeScene scene;
  std::array<int, 3> size;
  for (int& n : size) n = 5 + static_cast<int>(random.uniform(0, 14));
  const std::array<double, 3> spacing{1.0, random.uniform(0.6, 1.5), random.uniform(0.6, 3.0)};
  const glm::dvec3 wave{random.uniform(1, 4), random.uniform(1, 4), random.uniform(1, 4)};
  scene.grid = make_grid(size, spacing, format, [&](int i, int j, int k) {
    if (character == Character::rough) return random.uniform();
    return 0.5 + 0.5 * std::sin(wave.x * i / size[0]) * std::cos(wave.y * j / size[1]) *
                     std::sin(wave.z * k / size[2] + 0.5);
  });
  scene.transfer_function =
      character == Character::rough ? rough_table(random) : smooth_table(random);
  const glm::dvec3 extent = scene.box().hi;
  const glm::dvec3 direction = glm::normalize(
      glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
  scene.camera = look_at(0.5 * extent + random.uniform(0.2, 1.6) * glm::length(extent) * direction,
                         0.5 * extent, {0.1, 1, 0.05}, 50);
  scene.width = 29;
  scene.height = 23;
  scene.background = {0.25F, 0.125F, 0.5F, 1.0F};
  return scene;
}

}  // namespace triptych::reference
