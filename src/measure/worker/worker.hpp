#pragma once

#include <string_view>

#include "measure/contract/backend.hpp"
#include "measure/contract/suite.hpp"
#include "measure/plan/plan.hpp"

namespace triptych::measure {

// The worker's side: serves one device over the two file descriptors until the first is closed.
// Returns the process's exit code.
[[nodiscard]] int serve_worker(const Backend& backend, std::string_view device_id,
                               const FindSuite& find_suite, int request_fd, int answer_fd);

}  // namespace triptych::measure
