#pragma once
// Plans: YAML files with factors and their values. All combinations of the values are measured.

#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "measure/contract/suite.hpp"
#include "measure/plan/shard.hpp"
#include "record/check.hpp"

namespace triptych::measure {

struct Plan {
  std::string name;  // "volume/quick", or the file's name without its extension
  std::string suite;
  std::string summary;  // one line
  // Sorted so that the data set changes least often, the pipeline more often, and the viewport and
  // the camera most often.
  std::vector<Configuration> configurations;
  std::vector<std::string> varied;  // factors with more than one value
  // The checks by which the plan's runs are judged. Only the measurements needed for these checks
  // are made. For example, clocks are read only for the check `timing`, and workers run under the
  // emulator that counts instructions (counting/emulator.hpp) only for the check `cost`.
  record::Checks checks = default_checks();
  // The hash of the plan's YAML, which distinguishes plans with the same name. Empty if the plan
  // has no YAML.
  std::string hash;
  std::string argument = {};         // the plan argument as typed by the user
  std::set<std::string> named = {};  // factors that the YAML or an override sets
  // The factors with the value "auto", for which the fastest level is to be found.
  std::set<std::string> automatic = {};

  [[nodiscard]] static record::Checks default_checks();
  [[nodiscard]] bool timed() const { return checks.contains(record::Check::timing); }
  [[nodiscard]] bool counted() const { return checks.contains(record::Check::cost); }
  [[nodiscard]] bool compiled() const { return checks.contains(record::Check::code); }
  [[nodiscard]] bool judges_images() const;
  [[nodiscard]] bool judges_counters() const;
};

// Overrides from the command line: "--set factor=a,b".
using Overrides = std::vector<std::pair<std::string, std::vector<std::string>>>;
using FindSuite = std::function<Suite&(std::string_view name)>;  // throws InputError

// Loads a plan. `name_or_file` is "SUITE/PLAN" or a YAML file. The plan contains only the
// configurations of the shard. Throws InputError with file, line and column for an unknown or
// duplicate factor, a wrong type or level (with the most similar known name), an empty list, a
// duplicate value, and for more than a million configurations.
[[nodiscard]] Plan load_plan(std::string_view name_or_file, const Overrides& overrides,
                             const FindSuite& find_suite, const Shard& shard = {});

// Loads a plan without storing its configurations. Instead, they are passed to `use` one after the
// other. Throws the same exceptions as load_plan(), but allows up to a hundred million
// configurations.
Plan list_plan(std::string_view name_or_file, const Overrides& overrides,
               const FindSuite& find_suite, const Shard& shard,
               const std::function<void(const Suite&, const Configuration&)>& use);

// Returns the name under which a plan's runs are stored: the short name, or the name of the file
// without its extension. The file is not read.
[[nodiscard]] std::string plan_name(std::string_view name_or_file);

// Returns a plan that consists of the suite's defaults and the overrides. Throws the same
// exceptions as load_plan().
[[nodiscard]] Plan default_plan(const Suite& suite, const Overrides& overrides);

// Returns the key that identifies a configuration within its suite, in the canonical form
// "factor=value,…", sorted by name. It contains the factors that differ from the suite's defaults,
// and always `technique`, `data` and `camera`.
[[nodiscard]] std::string configuration_key(const Suite& suite, const Configuration& configuration);

// Returns the kinds of work ("compute", "draw") of the techniques in the plan's configurations,
// without duplicates. If times are measured, the clocks are calibrated for these kinds.
[[nodiscard]] std::vector<std::string> work_kinds(const Plan& plan);

}  // namespace triptych::measure
