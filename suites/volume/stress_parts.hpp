#pragma once
// Building blocks for stress scenes. They use only correctly rounded operations on doubles, so that
// the scenes are bit-identical on every machine.

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <string>

#include "suites/volume/stress_cases.hpp"

namespace triptych::volume_suite {

using Size = std::array<int, 3>;
using Voxel = std::function<double(int i, int j, int k)>;

// Returns a volume of 32-bit floats with the range 0…1.
[[nodiscard]] scene::Volume volume_of(const Size& size, const Voxel& voxel);

// A field with two blobs of different size and height, without any symmetry. Its values are 0…0.95,
// and about half of the volume is exactly 0.
[[nodiscard]] double asymmetric_value(const Size& size, int i, int j, int k);
[[nodiscard]] scene::Volume asymmetric_volume(const Size& size);

// Returns a transfer function whose entries all have this colour and opacity.
[[nodiscard]] scene::TransferFunction uniform(const std::array<float, 4>& rgba);
// Returns a transfer function that is transparent from entry 0 to `first`; after that, the opacity
// grows to `most` at the last entry. The colour changes from blue to orange.
[[nodiscard]] scene::TransferFunction ramp(int first, double most);

using scene::camera_looking_at;
// Returns a camera that looks along an axis. It is exact, because all components of forward and up
// are 0 or ±1.
[[nodiscard]] scene::Camera along(const glm::dvec3& eye, const glm::dvec3& forward,
                                  const glm::dvec3& up, double fov_y_deg);
// Returns a camera outside the volume, oblique to all axes, which sees the whole box.
[[nodiscard]] scene::Camera from_outside(const scene::Volume& volume);

// Returns a scene with this volume and ramp(20, 0.4), seen from outside.
[[nodiscard]] StressScene seen_from_outside(scene::Volume volume);
// Returns seen_from_outside() for the asymmetric field, in a volume of 24³ voxels.
[[nodiscard]] StressScene asymmetric_scene();

// These functions return the expectation that the image matches the image of another variant of the
// stress case. The parameter `data` is the name of that variant in a plan ("stress:CASE:VARIANT"),
// and `what` describes the expectation in findings. same_bits_as() requires bit-identical images.
// same_within_bounds_as() allows a difference of up to the sum of the two images' error bounds.
[[nodiscard]] record::Expectation same_bits_as(const std::string& data, std::string what);
[[nodiscard]] record::Expectation same_within_bounds_as(const std::string& data, std::string what);

}  // namespace triptych::volume_suite
