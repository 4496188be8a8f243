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
  // Ordered so that the data set changes least often, then the pipeline, and the view most often.
  std::vector<Configuration> configurations;
  std::vector<std::string> varied;  // factors with more than one value
  // The checks by which its runs are judged. Only the measurements that they need are made: clocks
  // are read only for timing, and workers run under the emulator only for cost.
  record::Checks checks = standard_checks();
  // The hash of its text, which distinguishes plans with the same name. Empty if it has no text.
  std::string hash;
  std::string argument = {};         // as typed by the user
  std::set<std::string> named = {};  // factors that its text or an override sets
  // The factors with the value "auto", which asks for the fastest of their levels.
  std::set<std::string> automatic = {};

  [[nodiscard]] static record::Checks standard_checks();
  [[nodiscard]] bool timed() const { return checks.contains(record::Check::timing); }
  [[nodiscard]] bool counted() const { return checks.contains(record::Check::cost); }
  [[nodiscard]] bool compiled() const { return checks.contains(record::Check::code); }
  [[nodiscard]] bool judges_pictures() const;
  [[nodiscard]] bool judges_counters() const;
};

// Overrides from the command line: "--set factor=a,b".
using Overrides = std::vector<std::pair<std::string, std::vector<std::string>>>;
using FindSuite = std::function<Suite&(std::string_view name)>;  // throws InputError

// `name_or_file` is "SUITE/PLAN" or a YAML file. Throws InputError with file, line and column for
// an unknown or duplicate factor, a wrong type or level (with the nearest known name), an empty
// list, a duplicate value, and for more than a million configurations. For a shard, only its own
// configurations are stored.
[[nodiscard]] Plan load_plan(std::string_view name_or_file, const Overrides& overrides,
                             const FindSuite& find_suite, const Shard& shard = {});

// The same plan without its configurations, which are passed to `use` in their order. Throws as
// load_plan does, but only for more than a hundred million configurations.
Plan list_plan(std::string_view name_or_file, const Overrides& overrides,
               const FindSuite& find_suite, const Shard& shard,
               const std::function<void(const Suite&, const Configuration&)>& use);

// The name under which a plan's runs are stored: a short name itself, or the name of a file without
// its extension. The file is not read.
[[nodiscard]] std::string plan_name(std::string_view name_or_file);

// A plan that consists of the suite's defaults and the overrides. Throws as load_plan does.
[[nodiscard]] Plan default_plan(const Suite& suite, const Overrides& overrides);

// Canonical "factor=value,…" of the factors that differ from the suite's defaults, and always
// `technique`, `data` and `camera`, sorted by name. It identifies a configuration within its suite.
[[nodiscard]] std::string configuration_key(const Suite& suite, const Configuration& configuration);

// The kinds of work (technique::name_of) in the plan's configurations, each once. To measure times,
// the clocks are calibrated for these kinds.
[[nodiscard]] std::vector<std::string> work_kinds(const Plan& plan);

}  // namespace triptych::measure
