#pragma once
// A device that plays a script; see backend.hpp.

#include <memory>
#include <string>

#include "backends/null/backend.hpp"

namespace triptych::null_backend {

// The devices of a script, in order.
[[nodiscard]] std::vector<record::Device> devices_of(const Script& script);

// `index` into Script::devices.
[[nodiscard]] std::unique_ptr<measure::Device> make_device(std::shared_ptr<const Script> script,
                                                           std::size_t index);

// Performs the script's first failure for this place, if there is one: it throws, ends the process
// or never returns. Globs are matched against `subject`. `number` is the number of the frame or, at
// prepare, of the work's preparation.
void play_failure(const Script& script, Place at, const std::string& subject, int number = 0);

// The first failure that concerns the image: Place::image, wrong_image or nan_image.
[[nodiscard]] std::optional<FailureKind> image_failure(const Script& script,
                                                       const std::string& subject);

// fnmatch(3) without flags.
[[nodiscard]] bool matches(const std::string& glob, const std::string& subject);

void log_call(const Script& script, std::string call);

}  // namespace triptych::null_backend
