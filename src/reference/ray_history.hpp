#pragma once
// The samples of one pixel of the reference image, with the errors that a device's samples may
// have.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "reference/field.hpp"
#include "reference/opacity.hpp"
#include "reference/table.hpp"
#include "reference/volume.hpp"

namespace triptych::reference {

struct HistorySample {
  std::int64_t index = 0;
  glm::dvec3 place{};  // in voxels; the middle of a step
  glm::dvec3 place_error{};
  std::optional<Bounded> front;  // for quadrature preintegrated: where the step begins
  Bounded value;                 // and where it ends
  Looked looked;                 // after shading; for a step, the alphas are not used
  StepLength length;             // in voxel lengths
  StepOpacity opacity;
};

struct RayHistory {
  glm::dvec3 entry{};                  // in voxels
  glm::dvec3 stride{};                 // length of one step, in voxels
  std::vector<HistorySample> samples;  // samples of every index, including those without opacity
};

// The ray of pixel (x, y) in render_volume with the same model. Quadrature midpoint and
// preintegrated only: cells have no samples with numbers. Throws as render_volume does.
[[nodiscard]] RayHistory ray_history(const scene::VolumeScene& scene, const ErrorModel& model,
                                     int x, int y);

}  // namespace triptych::reference
