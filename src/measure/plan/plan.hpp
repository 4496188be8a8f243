#pragma once
// Plans: factors and their values in YAML; all combinations are made.

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
  std::string name;  // "volume/quick", or the file's name without its ending
  std::string suite;
  std::string summary;  // one line
  std::vector<Configuration>
      configurations;               // in order: data varies slowest, then pipelines, then views
  std::vector<std::string> varied;  // factors with more than one value
  // What its runs are judged by. Only what they need is measured: no clock is read where timing is
  // not among them, and where cost is, workers run under the emulator.
  record::Checks checks = standard_checks();
  // Of its text: another plan of the same name has another. Empty where it has no text.
  std::string hash;
  std::string argument = {};         // as it was typed
  std::set<std::string> named = {};  // factors that its text or an override names
  // Those of which it says "auto": the fastest of their levels is asked for.
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

// `name_or_file`: "SUITE/PLAN" or a YAML file. Throws InputError with file, line and column for an
// unknown or duplicate factor, a wrong type or level (the nearest known name is suggested), an
// empty list, a duplicate value, and for more than a million configurations. Of a shard only its
// own configurations are held.
[[nodiscard]] Plan load_plan(std::string_view name_or_file, const Overrides& overrides,
                             const FindSuite& find_suite, const Shard& shard = {});

// The same plan without its configurations, each handed to `use` in their order. Throws as load_plan
// does, but only for more than a hundred million configurations.
Plan list_plan(std::string_view name_or_file, const Overrides& overrides,
               const FindSuite& find_suite, const Shard& shard,
               const std::function<void(const Suite&, const Configuration&)>& use);

// The name under which a plan's runs are stored: of a short name itself, of a file its name without
// the ending. Reads nothing.
[[nodiscard]] std::string plan_name(std::string_view name_or_file);

// The suite's defaults with the overrides, as a plan of its own. Throws as load_plan does.
[[nodiscard]] Plan default_plan(const Suite& suite, const Overrides& overrides);

// Canonical "factor=value,…" of the factors that differ from the suite's defaults, always with
// `technique`, `data` and `camera`, sorted by name: identifies a configuration within its suite.
[[nodiscard]] std::string configuration_key(const Suite& suite, const Configuration& configuration);

// The kinds of work that its configurations are (technique::name_of), each once: those whose clocks
// its times need.
[[nodiscard]] std::vector<std::string> work_kinds(const Plan& plan);

}  // namespace triptych::measure
