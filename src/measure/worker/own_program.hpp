#pragma once
// This program starts itself again in separate processes that use devices. A process that is
// started as "worker --device ID" calls serve_worker(). A process that is started as "list-api API"
// calls answer_listing() (measure/worker/listing.hpp), and one that is started as "probe-features
// ID" calls answer_features() (measure/worker/feature_run.hpp).

#include <string>
#include <vector>

namespace triptych::measure {

// Returns the path of this program's executable file.
[[nodiscard]] std::string own_program();

// Returns a value for SideOptions::command that starts a worker of this program or of another build
// of it. `more` contains additional arguments.
[[nodiscard]] std::vector<std::string> worker_command(std::string program = own_program(),
                                                      const std::vector<std::string>& more = {});

}  // namespace triptych::measure
