#pragma once
// The volume techniques of this API; each is implemented in the file of its name. Both functions
// are called with the context current.

#include <memory>
#include <optional>
#include <string>

#include "backends/gl/context.hpp"
#include "backends/gl/timing.hpp"
#include "measure/backend.hpp"

namespace triptych::gl_backend {

struct VolumeTechnique {
  // Beyond volume_unsupported(): what this technique alone needs.
  std::optional<std::string> (*unsupported)(const Api& gl, const measure::VolumeWork& work);
  std::unique_ptr<measure::Prepared> (*prepare)(Context& context, Stamps stamps,
                                                const measure::VolumeWork& work);
};

[[nodiscard]] VolumeTechnique raycast();
[[nodiscard]] VolumeTechnique raycast_fragment();
[[nodiscard]] VolumeTechnique speed_of_light();

}  // namespace triptych::gl_backend
