#pragma once
// Typed errors. They are thrown where the cause is known and caught once per configuration (worker)
// or once per command (app), where they become a record or an exit code.

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

#include "core/code_place.hpp"

namespace triptych::core {

// What the program answers to its caller. Precedence when several apply: usage, regression,
// cannot_judge, pass. `skip` is CTest's SKIP_RETURN_CODE.
enum class ExitCode : int { pass = 0, regression = 1, cannot_judge = 2, usage = 3, skip = 77 };

// Base of all our errors: what() is one line, ready to be shown.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A place in a text or binary file; line and column count from 1, 0 means "not known".
struct FilePlace {
  std::string file;
  int line = 0;
  int column = 0;
};

// Bad input: a broken file, an unknown factor, a wrong type. Becomes exit code 3.
// what() reads "FILE:LINE:COLUMN: MESSAGE".
class InputError : public Error {
 public:
  InputError(FilePlace place, const std::string& message);
  explicit InputError(const std::string& message) : Error(message) {}
  [[nodiscard]] const FilePlace& place() const noexcept { return place_; }

 private:
  FilePlace place_;
};

// Reading or writing failed for a reason outside the content: read-only folder, full disk. Exit
// code 3.
class IoError : public Error {
 public:
  using Error::Error;
};

// The device or technique cannot do this; the message is the reason shown with the skip.
class NotSupported : public Error {
 public:
  using Error::Error;
};

// A call of a graphics or compute API failed. what() reads "CALL returned CODE at FILE:LINE".
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

// The device is gone; the worker must be replaced before anything else runs on it.
class DeviceLost : public ApiError {
 public:
  using ApiError::ApiError;
};

}  // namespace triptych::core
