#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "backends/gl/context.hpp"
#include "backends/gl/pass.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::gl_backend {

// The constants of every volume technique are made here.
[[nodiscard]] Constants constants_of(const measure::VolumeWork& work);

// The reason why this volume and image exceed the limits that every volume technique needs (storage
// blocks, sizes of textures and buffers); empty if they do not.
[[nodiscard]] std::optional<std::string> volume_unsupported(const Api& gl,
                                                            std::string_view technique,
                                                            const measure::VolumeWork& work);

// A volume technique with its scene: the data are uploaded and the program is linked. The context
// must be current when it is made and must outlive it.
[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_volume(Context& context, Stamps stamps,
                                                                const measure::VolumeWork& work,
                                                                const Constants& constants,
                                                                std::unique_ptr<Pass> pass);

}  // namespace triptych::gl_backend
