#pragma once
// The CI system in whose job the program runs, and the output for that system.

#include <cstdint>
#include <filesystem>
#include <string>

#include "app/arguments.hpp"

namespace triptych::app {

enum class CiSystem : std::uint8_t { none, github, gitlab };

// Adds --ci. Its value is given to ci_system().
void add_ci_option(CLI::App& command, std::string& name);
inline constexpr const char* standard_ci = "auto";
// "auto" selects the system by its environment variables. Throws InputError for an unknown name.
[[nodiscard]] CiSystem ci_system(const std::string& name);

// The top folder of the repository to which this job belongs: the system's variable, or the working
// directory.
[[nodiscard]] std::filesystem::path ci_repository(CiSystem system);
// The file that defines the job, relative to that folder; empty if it is not known.
[[nodiscard]] std::string ci_job_file(CiSystem system);
// Appends Markdown to the summary of the job, where the system has one.
void add_to_job_summary(CiSystem system, const std::string& markdown);

// While an object of this class exists, all output goes to one section of the log, which readers
// can fold.
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
