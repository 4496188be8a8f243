#pragma once
// The CI system that runs this program, and the output that is written for that system.

#include <cstdint>
#include <filesystem>
#include <string>

#include "app/arguments.hpp"

namespace triptych::app {

enum class CiSystem : std::uint8_t { none, github, gitlab };

// Adds --ci, whose value is meant for ci_system().
void add_ci_option(CLI::App& command, std::string& name);
inline constexpr const char* standard_ci = "auto";
// Returns the CI system with that name. "auto" detects the system from its environment variables.
// Throws InputError for an unknown name.
[[nodiscard]] CiSystem ci_system(const std::string& name);

// Returns the top folder of the repository to which this job belongs. It is read from an
// environment variable of the CI system; without one it is the working directory.
[[nodiscard]] std::filesystem::path ci_repository(CiSystem system);
// Returns the file that defines the job, relative to the repository's top folder, or an empty
// string if that file is not known.
[[nodiscard]] std::string ci_job_file(CiSystem system);
// Appends Markdown to the job summary if the CI system has one.
void add_to_job_summary(CiSystem system, const std::string& markdown);

// While an object of this class exists, all output goes to one section of the log. Readers of the
// log can collapse this section.
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
