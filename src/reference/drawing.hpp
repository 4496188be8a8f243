#pragma once
// Code that the renderers in this folder share: checking a scene and filling an image.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <numeric>
#include <vector>

#include "core/error.hpp"
#include "reference/composite.hpp"
#include "reference/rows.hpp"
#include "reference/volume.hpp"
#include "scene/half.hpp"
#include "scene/volume_scene.hpp"

namespace triptych::reference {

// Throws InputError if the scene cannot be drawn.
inline void check(const scene::VolumeScene& scene) {
  if (!scene.grid) throw core::InputError("the scene has no volume");
  const scene::VoxelGrid& grid = *scene.grid;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (grid.size[axis] < 1 || !(grid.spacing[axis] > 0)) {
      throw core::InputError(
          "a volume needs at least one voxel and a positive spacing along each axis");
    }
  }
  if (grid.data.size() != grid.voxel_count() * scene::bytes_of(grid.format)) {
    throw core::InputError("the volume's data does not match its size and format");
  }
  if (!(scene.step_voxels > 0)) throw core::InputError("the step must be positive");
  if (scene.width < 0 || scene.height < 0) {
    throw core::InputError("the width and height of the viewport must not be negative");
  }
}

// Calls function(Stored{}), where Stored is the type of the grid's voxels.
template <typename Function>
auto with_stored_type(scene::VoxelFormat format, Function&& function) {
  switch (format) {
    case scene::VoxelFormat::u8:
      return function(std::uint8_t{});
    case scene::VoxelFormat::u16:
      return function(std::uint16_t{});
    case scene::VoxelFormat::f16:
      return function(scene::Half{});
    case scene::VoxelFormat::f32:
      break;
  }
  return function(float{});
}

// Returns, for each axis, the factor that converts the derivative per voxel length along this axis
// to the derivative per smallest spacing.
inline glm::dvec3 gradient_scale(const scene::VoxelGrid& grid) {
  const double smallest = *std::min_element(grid.spacing.begin(), grid.spacing.end());
  return {smallest / grid.spacing[0], smallest / grid.spacing[1], smallest / grid.spacing[2]};
}

// Draws an image whose pixel (x, y) is caster(x, y). Every thread calls make_caster() to get its
// own caster. `on_rows` is called as in for_each_row().
template <typename MakeCaster>
Truth draw(const scene::VolumeScene& scene, int threads, const MakeCaster& make_caster,
           const OnRows& on_rows = {}) {
  Truth truth;
  truth.width = scene.width;
  truth.height = scene.height;
  const auto width = static_cast<std::size_t>(scene.width);
  const auto pixels = width * static_cast<std::size_t>(scene.height);
  truth.rgba.resize(4 * pixels);
  truth.bound.resize(pixels);
  std::vector<std::uint64_t> samples(static_cast<std::size_t>(scene.height));
  for_each_row(
      scene.height, threads,
      [&]() -> RowWorker {
        // A shared pointer is used because std::function requires a callable that can be copied.
        auto caster = std::make_shared<decltype(make_caster())>(make_caster());
        return [&truth, &samples, width, caster](int y) {
          for (std::size_t x = 0; x < width; ++x) {
            const Pixel pixel = (*caster)(static_cast<int>(x), y);
            const std::size_t index = static_cast<std::size_t>(y) * width + x;
            std::copy(pixel.rgba.begin(), pixel.rgba.end(),
                      truth.rgba.begin() + static_cast<std::ptrdiff_t>(4 * index));
            truth.bound[index] = pixel.bound;
            samples[static_cast<std::size_t>(y)] += pixel.samples;
          }
        };
      },
      on_rows);
  truth.samples = std::accumulate(samples.begin(), samples.end(), std::uint64_t{0});
  return truth;
}

}  // namespace triptych::reference
