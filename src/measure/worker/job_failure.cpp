#include "measure/worker/job_failure.hpp"

#include <sys/resource.h>

namespace triptych::measure {

record::Reason out_of_memory(const std::string& data) {
  record::Reason reason{.cause = record::Cause::out_of_memory, .subject = data};
  rlimit limit{};
  if (::getrlimit(RLIMIT_DATA, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    reason.numbers["limit_bytes"] = static_cast<double>(limit.rlim_cur);
  }
  return reason;
}

record::Reason api_reason(record::Cause cause, const core::ApiError& error) {
  return {.cause = cause, .subject = error.call(), .code = error.code(), .detail = error.what()};
}

}  // namespace triptych::measure
