#pragma once
// Temporary folders and environment variables that are restored at the end of a test.

#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <optional>
#include <string>

#include "core/temporary_folder.hpp"

namespace triptych::measure {

using ScratchFolder = core::TemporaryFolder;

// Sets an environment variable, or unsets it if no value is given. The destructor restores the
// previous value.
class Variable {
 public:
  explicit Variable(std::string name, const std::optional<std::string>& value = std::nullopt)
      : name_(std::move(name)) {
    if (const char* before = ::getenv(name_.c_str())) before_ = before;
    set(value);
  }
  ~Variable() { set(before_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  void set(const std::optional<std::string>& value) const {
    if (value) {
      ::setenv(name_.c_str(), value->c_str(), 1);
    } else {
      ::unsetenv(name_.c_str());
    }
  }
  std::string name_;
  std::optional<std::string> before_;
};

}  // namespace triptych::measure
