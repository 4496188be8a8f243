#pragma once
// Detects the CI system that runs this program, and writes output in the format of that CI system.

#include <cstdint>
#include <filesystem>
#include <string>

#include "app/arguments.hpp"

namespace triptych::app {

enum class CiSystem : std::uint8_t { none, github, gitlab };

// Adds --ci. Pass its value to ci_system().
void add_ci_option(CLI::App& command, std::string& name);
inline constexpr const char* default_ci = "auto";
// Returns the CI system with that name. "auto" detects the system from its environment variables.
// Throws InputError for an unknown name.
[[nodiscard]] CiSystem ci_system(const std::string& name);

// Returns the root folder of the checked-out repository. The CI system provides it in an
// environment variable; if that variable is not set, returns the working directory.
[[nodiscard]] std::filesystem::path ci_repository(CiSystem system);
// Returns the path of the file that defines the CI job, relative to the repository's root folder,
// or an empty string if the path is unknown.
[[nodiscard]] std::string ci_job_file(CiSystem system);
// Appends Markdown to the job summary if the CI system has one.
void add_to_job_summary(CiSystem system, const std::string& markdown);

// A collapsible section of the CI log. It contains everything that is printed during the lifetime
// of the object.
class LogSection {
 public:
  LogSection(CiSystem system, std::string title);
  ~LogSection();
  LogSection(const LogSection&) = delete;
  LogSection& operator=(const LogSection&) = delete;

 private:
  CiSystem system_;
  std::string name_;
};

}  // namespace triptych::app
