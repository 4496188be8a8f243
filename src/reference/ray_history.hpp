#pragma once
// The samples of one pixel of the reference image, with the errors that these samples may have on a
// device.

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
  glm::dvec3 place{};  // position in voxels; for a step, its midpoint
  glm::dvec3 place_error{};
  std::optional<Bounded> front;  // the value at the front of a step, for quadrature=preintegrated
  Bounded value;                 // the value at the sample, or at the back of the step
  TableLookup lookup;            // after shading; for a step, the alphas are not used
  StepLength length;             // in voxel lengths
  StepOpacity opacity;
};

struct RayHistory {
  glm::dvec3 entry{};                  // in voxels
  glm::dvec3 stride{};                 // length of one step, in voxels
  std::vector<HistorySample> samples;  // samples of every index, including those without opacity
};

// Returns the samples that render_volume takes for pixel (x, y) with the same model. It supports
// only the quadratures midpoint and preintegrated, because the samples of quadrature=cells have no
// indices. Throws the same errors as render_volume.
[[nodiscard]] RayHistory ray_history(const scene::VolumeScene& scene, const ErrorModel& model,
                                     int x, int y);

}  // namespace triptych::reference
