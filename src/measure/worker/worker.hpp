#pragma once

#include <string_view>

#include "measure/contract/backend.hpp"
#include "measure/contract/suite.hpp"
#include "measure/plan/plan.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// The worker's side: serves one device over the two file descriptors until the first one is closed.
// Returns the exit code of the process.
[[nodiscard]] int serve_worker(const Backend& backend, std::string_view device_id,
                               const FindSuite& find_suite, int request_fd, int answer_fd);

// Records the facts about the data and the path that are needed to judge the image.
void describe_work(const Work& work, const Device& device, record::Record& record);

}  // namespace triptych::measure
