#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "backends/gl/context.hpp"
#include "backends/gl/pass.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::gl_backend {

// Returns the compile-time constants of every volume technique.
[[nodiscard]] Constants constants_of(const measure::VolumeWork& work);

// Returns the reason why this volume and image exceed a limit that applies to every volume
// technique (storage blocks, sizes of textures and buffers); nullopt if they do not.
[[nodiscard]] std::optional<std::string> volume_unsupported(const Api& gl,
                                                            std::string_view technique,
                                                            const measure::VolumeWork& work);

// Prepares a volume technique with its scene: uploads the data and links the program. The context
// must be current during this call and must outlive the result.
[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_volume(Context& context, Stamps stamps,
                                                                const measure::VolumeWork& work,
                                                                const Constants& constants,
                                                                std::unique_ptr<Pass> pass);

}  // namespace triptych::gl_backend
