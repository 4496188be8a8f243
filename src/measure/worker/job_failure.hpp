#pragma once
// Converts the errors of a job to outcomes of its configuration.

#include <exception>
#include <new>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "measure/contract/not_drawn.hpp"
#include "record/reason.hpp"

namespace triptych::measure {

// Thrown if the input is invalid. The configuration is skipped, because this is not the device's
// fault.
struct BadInput : core::NotSupported {
  using NotSupported::NotSupported;
};

// Thrown if a data file is missing. The configuration is skipped, because this is not the device's
// fault.
class MissingData : public core::NotSupported {
 public:
  MissingData(const std::string& reason, std::string data)
      : NotSupported(reason), data_(std::move(data)) {}
  [[nodiscard]] const std::string& data() const { return data_; }

 private:
  std::string data_;
};

// Returns the reason for a failure due to exhausted host memory while the data set `data` was used.
// It contains the memory limit of the worker, if --memory or the user's resource limits set a
// limit.
[[nodiscard]] record::Reason out_of_memory(const std::string& data);

[[nodiscard]] record::Reason api_reason(record::Cause cause, const core::ApiError& error);

// Runs `action`, and converts each type of error to the outcome of the configuration. `data` is the
// name of the data set that is reported if memory is exhausted.
template <typename Action, typename OnFailure>
void outcome_of(const Action& action, const std::string& data, const OnFailure& on_failure) {
  using record::Cause;
  using record::Outcome;
  try {
    action();
  } catch (const BadInput& error) {
    on_failure(Outcome::skipped, {.cause = Cause::bad_input, .detail = error.what()});
  } catch (const MissingData& error) {
    on_failure(Outcome::skipped,
               {.cause = Cause::not_supported, .subject = error.data(), .detail = error.what()});
  } catch (const core::NotSupported& error) {
    on_failure(Outcome::skipped, {.cause = Cause::not_supported, .detail = error.what()});
  } catch (const core::DeviceLost& error) {
    on_failure(Outcome::lost, api_reason(Cause::device_lost, error));
  } catch (const core::ApiError& error) {
    on_failure(Outcome::failed, api_reason(Cause::api_error, error));
  } catch (const NotDrawn& error) {
    on_failure(Outcome::failed, {.cause = Cause::not_drawn, .detail = error.what()});
  } catch (const std::bad_alloc&) {
    on_failure(Outcome::failed, out_of_memory(data));
  } catch (const std::exception& error) {
    on_failure(Outcome::failed, {.cause = Cause::error, .detail = error.what()});
  }
}

}  // namespace triptych::measure
