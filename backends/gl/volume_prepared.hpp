#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "backends/gl/context.hpp"
#include "backends/gl/pass.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::gl_backend {

// Where every volume technique's constants come from.
[[nodiscard]] Constants constants_of(const measure::VolumeWork& work);

// Why this volume and picture are beyond what every volume technique needs: storage blocks, sizes
// of textures and buffers. Empty when they are not.
[[nodiscard]] std::optional<std::string> volume_unsupported(const Api& gl,
                                                            std::string_view technique,
                                                            const measure::VolumeWork& work);

// A volume technique with its scene: data uploaded, program linked. The context must be current
// when it is made and must outlive it.
[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_volume(Context& context, Stamps stamps,
                                                                const measure::VolumeWork& work,
                                                                const Constants& constants,
                                                                std::unique_ptr<Pass> pass);

}  // namespace triptych::gl_backend
