#pragma once
// Building blocks of the stress scenes. They use only arithmetic on doubles that is exactly
// rounded, so that a case is the same on every machine.

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <string>

#include "suites/volume/stress_cases.hpp"

namespace triptych::volume_suite {

using Size = std::array<int, 3>;
using Voxel = std::function<double(int i, int j, int k)>;

// A volume of 32-bit floats with the range 0…1.
[[nodiscard]] scene::Volume volume_of(const Size& size, const Voxel& voxel);

// Two blobs of different size and height, without any symmetry. Values are 0…0.95, and about half
// of the volume is exactly 0.
[[nodiscard]] double lopsided(const Size& size, int i, int j, int k);
[[nodiscard]] scene::Volume lopsided_volume(const Size& size);

// A transfer function whose entries all have this colour and opacity.
[[nodiscard]] scene::TransferFunction uniform(const std::array<float, 4>& rgba);
// A transfer function that is transparent from 0 to the entry `first`; then opacity grows to `most`
// at the last entry. The colour changes from blue to orange.
[[nodiscard]] scene::TransferFunction ramp(int first, double most);

using scene::looking;
// A camera along an axis. It is exact, because forward and up have only the components 0 and ±1.
[[nodiscard]] scene::Camera along(const glm::dvec3& eye, const glm::dvec3& forward,
                                  const glm::dvec3& up, double fov_y_deg);
// A camera outside, oblique to all axes, with the whole box in view.
[[nodiscard]] scene::Camera from_outside(const scene::Volume& volume);

// The volume with ramp(20, 0.4), seen from outside.
[[nodiscard]] StressScene seen_from_outside(scene::Volume volume);
// The lopsided volume of 24³ voxels, seen in the same way.
[[nodiscard]] StressScene lopsided_scene();

// Expects the same image as that of another variant. `data` is its name in a plan.
[[nodiscard]] record::Expectation same_bits_as(const std::string& data, std::string what);
[[nodiscard]] record::Expectation same_within_bounds_as(const std::string& data, std::string what);

}  // namespace triptych::volume_suite
