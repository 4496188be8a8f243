#pragma once

#include <string_view>

#include "measure/contract/backend.hpp"
#include "measure/contract/suite.hpp"
#include "measure/plan/plan.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// The worker's side: serves one device over the two file descriptors until the first is closed.
// Returns the process's exit code.
[[nodiscard]] int serve_worker(const Backend& backend, std::string_view device_id,
                               const FindSuite& find_suite, int request_fd, int answer_fd);

// What is known of the data and of the path it takes, for judging the image.
void describe_work(const Work& work, const Device& device, record::Record& record);

}  // namespace triptych::measure
