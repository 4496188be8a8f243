#pragma once
// This program also serves devices in separate processes. Started as "worker --device ID" it calls
// serve_worker(), and started as "list-api API" it calls answer_listing()
// (measure/worker/listing.hpp).

#include <string>
#include <vector>

namespace triptych::measure {

// The file of this program.
[[nodiscard]] std::string own_program();

// The value of SideOptions::command for this program, or for another build of it. `more`: further
// arguments.
[[nodiscard]] std::vector<std::string> worker_command(std::string program = own_program(),
                                                      const std::vector<std::string>& more = {});

}  // namespace triptych::measure
