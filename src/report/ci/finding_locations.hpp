#pragma once
// Finds the place in a repository to which a CI system attaches a finding: the line of a stored
// value, or a file.

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

#include "judge/gate/gate.hpp"
#include "record/record.hpp"

namespace triptych::report {

struct SourceLocation {
  std::string file;  // relative to the repository; empty if there is no place
  std::size_t line = 1;
};

class FindingLocations {
 public:
  struct Sources {
    std::filesystem::path repository;  // the root folder of the repository
    std::filesystem::path baselines;   // the folder of the baselines that were used
    std::map<std::string, record::Device> devices = {};  // devices of all results, by id
    std::string job = {};  // the file that defines the CI job, relative to the repository
  };

  explicit FindingLocations(Sources sources);

  // Returns the line of the stored value with which the configuration was compared, if its file is
  // in the repository. Otherwise returns the first line of the baselines' manifest, of the plan's
  // file, or of the file that defines the CI job.
  [[nodiscard]] SourceLocation of(const judge::Finding& finding,
                                  const judge::GateResult& result) const;

 private:
  [[nodiscard]] std::string in_repository(const std::filesystem::path& file) const;
  [[nodiscard]] const std::string& text_of(const std::filesystem::path& file) const;

  Sources sources_;
  mutable std::map<std::filesystem::path, std::string> texts_;
};

}  // namespace triptych::report
