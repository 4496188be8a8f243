#pragma once
// Typed errors, which are thrown where the cause is known. An error that no other code handles ends
// in one of two places. The worker (the process that draws on a device) stores it as the result of
// the configuration. The function main() in src/app turns it into the exit code of the command.

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

#include "core/code_place.hpp"

namespace triptych::core {

// The exit code of the program. If several apply, the program returns the most severe one; see
// worse_of() in core/exit_code.hpp. `skip` is the value of the CTest property SKIP_RETURN_CODE of
// Triptych's tests, so CTest reports a test that exits with this code as skipped.
enum class ExitCode : int { pass = 0, regression = 1, cannot_judge = 2, usage = 3, skip = 77 };

// The base class of all errors of this project. what() is a single line, ready to be printed.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A place in a text or binary file. Lines and columns are 1-based; 0 means unknown.
struct FilePlace {
  std::string file;
  int line = 0;
  int column = 0;
};

// Bad input, such as a broken file, a wrong type or an unknown factor (setting). what() has the
// form "FILE:LINE:COLUMN: MESSAGE". Leads to exit code 3.
class InputError : public Error {
 public:
  InputError(FilePlace place, const std::string& message);
  explicit InputError(const std::string& message) : Error(message) {}
  [[nodiscard]] const FilePlace& place() const noexcept { return place_; }

 private:
  FilePlace place_;
};

// A file could not be read or written for a reason other than its content, for example because the
// folder is read-only or the disk is full. Leads to exit code 3.
class IoError : public Error {
 public:
  using Error::Error;
};

// The device or technique does not support the requested configuration. The configuration is
// skipped, and the message is printed as the reason.
class NotSupported : public Error {
 public:
  using Error::Error;
};

// A graphics or compute API call failed. what() has the form "CALL returned CODE at FILE:LINE".
class ApiError : public Error {
 public:
  ApiError(std::string call, std::string code, const std::string& detail = {},
           core::CodePlace place = core::CodePlace::current());
  [[nodiscard]] const std::string& call() const noexcept { return call_; }
  [[nodiscard]] const std::string& code() const noexcept { return code_; }

 private:
  std::string call_;
  std::string code_;
};

// The device is lost. The worker process must be replaced before anything else runs on the device.
class DeviceLost : public ApiError {
 public:
  using ApiError::ApiError;
};

}  // namespace triptych::core
