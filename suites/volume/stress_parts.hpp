#pragma once
// Building blocks of the stress scenes. Arithmetic on doubles that is exactly rounded, so that a
// case is the same on every machine.

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <string>

#include "suites/volume/stress_cases.hpp"

namespace triptych::volume_suite {

using Size = std::array<int, 3>;
using Voxel = std::function<double(int i, int j, int k)>;

// Voxels of 32-bit floats with the range 0…1.
[[nodiscard]] scene::Volume volume_of(const Size& size, const Voxel& voxel);

// Two blobs of unlike size and height, without any symmetry; about half of the volume is exactly 0.
// 0…0.95.
[[nodiscard]] double lopsided(const Size& size, int i, int j, int k);
[[nodiscard]] scene::Volume lopsided_volume(const Size& size);

// Entries of one colour and opacity.
[[nodiscard]] scene::TransferFunction uniform(const std::array<float, 4>& rgba);
// Transparent at 0 and up to `first`, from there growing to `most` at the last entry; the colour
// turns from blue to orange.
[[nodiscard]] scene::TransferFunction ramp(int first, double most);

using scene::looking;
// Along an axis, exactly: forward and up have components 0 and ±1 only.
[[nodiscard]] scene::Camera along(const glm::dvec3& eye, const glm::dvec3& forward,
                                  const glm::dvec3& up, double fov_y_deg);
// From outside, oblique to all axes, all of the box in view.
[[nodiscard]] scene::Camera from_outside(const scene::Volume& volume);

// The volume by ramp(20, 0.4) from outside.
[[nodiscard]] StressScene seen_from_outside(scene::Volume volume);
// The lopsided volume of 24³ voxels likewise.
[[nodiscard]] StressScene lopsided_scene();

// The same picture as another variant's, which is spelled as in a plan.
[[nodiscard]] record::Expectation same_bits_as(const std::string& data, std::string what);
[[nodiscard]] record::Expectation same_within_bounds_as(const std::string& data, std::string what);

}  // namespace triptych::volume_suite
