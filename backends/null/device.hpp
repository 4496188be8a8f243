#pragma once
// A device that follows a script (see backend.hpp).

#include <memory>
#include <string>

#include "backends/null/backend.hpp"

namespace triptych::null_backend {

// Returns the devices of a script, in order.
[[nodiscard]] std::vector<record::Device> devices_of(const Script& script);

// `index` is an index into Script::devices.
[[nodiscard]] std::unique_ptr<measure::Device> make_device(std::shared_ptr<const Script> script,
                                                           std::size_t index);

// Triggers the first failure in the script that matches this place, if there is one: throws, ends
// the process or never returns. `subject` is matched against the globs. `number` is the number of
// the frame or, at Place::prepare, of the work's preparation.
void trigger_failure(const Script& script, Place at, const std::string& subject, int number = 0);

// Returns the first failure that affects the image: wrong_image, nan_image or another failure at
// Place::image.
[[nodiscard]] std::optional<FailureKind> image_failure(const Script& script,
                                                       const std::string& subject);

// Returns whether `subject` matches the glob, as fnmatch(3) without flags does.
[[nodiscard]] bool matches(const std::string& glob, const std::string& subject);

// Records that this process has prepared work with this description. A failure with `after` happens
// only if such work was prepared before.
void record_prepared(const std::string& description);

void log_call(const Script& script, std::string call);

}  // namespace triptych::null_backend
