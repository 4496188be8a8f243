#pragma once

#include <string_view>

#include "measure/contract/backend.hpp"
#include "measure/contract/suite.hpp"
#include "measure/plan/plan.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// The main function of a worker: serves one device over two pipes until the pipe `request_fd` is
// closed. Returns the exit code of the process.
[[nodiscard]] int serve_worker(const Backend& backend, std::string_view device_id,
                               const FindSuite& find_suite, int request_fd, int answer_fd);

// Stores in the record the hash of the data, and those properties of the device that determine the
// error bound of the image (Record::precision).
void describe_work(const Work& work, const Device& device, record::Record& record);

}  // namespace triptych::measure
