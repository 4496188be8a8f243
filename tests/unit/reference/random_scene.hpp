#pragma once
// Creates seeded random scenes for the tests in this folder.

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>

#include "scene/volume_scene.hpp"

namespace triptych::reference {

// Creates a grid from a function that maps the indices of a voxel to a normalised value in [0, 1].
[[nodiscard]] std::shared_ptr<const scene::VoxelGrid> make_grid(
    const std::array<int, 3>& size, const std::array<double, 3>& spacing, scene::VoxelFormat format,
    const std::function<double(int, int, int)>& value);

[[nodiscard]] scene::Camera look_at(const glm::dvec3& eye, const glm::dvec3& target,
                                    const glm::dvec3& up = {0, 1, 0}, double fov_y_deg = 45);

// Returns a transfer function with the same RGBA (not premultiplied) for every value.
[[nodiscard]] scene::TransferFunction constant_table(const std::array<float, 4>& rgba);

enum class Character {
  smooth,  // low frequencies and a smooth table, as in real data
  rough    // white noise, and a table of random entries with peaks, zeros and full opacity
};
[[nodiscard]] scene::VolumeScene random_scene(std::uint64_t seed, Character character,
                                              scene::VoxelFormat format);

}  // namespace triptych::reference
