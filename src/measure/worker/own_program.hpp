#pragma once
// This program starts itself again in separate processes that use devices. If it is started as
// "worker --device ID", it calls serve_worker(). If it is started as "list-api API", it calls
// answer_listing() (measure/worker/listing.hpp).

#include <string>
#include <vector>

namespace triptych::measure {

// Returns the path of this program's file.
[[nodiscard]] std::string own_program();

// Returns the value of SideOptions::command for this program or for another build of it. `more`
// contains further arguments.
[[nodiscard]] std::vector<std::string> worker_command(std::string program = own_program(),
                                                      const std::vector<std::string>& more = {});

}  // namespace triptych::measure
