#pragma once
// This program serves devices in processes of its own. Started as "worker --device ID" it calls
// serve_worker(), as "list-api API" it calls answer_listing() (measure/worker/listing.hpp).

#include <string>
#include <vector>

namespace triptych::measure {

// Its file.
[[nodiscard]] std::string own_program();

// SideOptions::command of this program, or of another build of it; `more`: further arguments.
[[nodiscard]] std::vector<std::string> worker_command(std::string program = own_program(),
                                                      const std::vector<std::string>& more = {});

}  // namespace triptych::measure
