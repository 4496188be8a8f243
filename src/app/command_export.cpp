#include <fmt/format.h>

#include <algorithm>

#include "app/arguments.hpp"
#include "app/terminal.hpp"
#include "app/verdicts.hpp"
#include "app/version.hpp"
#include "core/output_files.hpp"
#include "measure/plan/plan.hpp"
#include "record/store.hpp"
#include "report/exports/export_tables.hpp"

namespace triptych::app {
namespace {

struct ExportArguments {
  std::vector<std::string> stores;
  std::string out;
  std::string plan;
  bool json = false;
};

// The plan's name in the stores, or the name of the file that was run.
std::string plan_in(const std::vector<record::Store>& stores, const std::string& plan) {
  const bool named = std::ranges::any_of(
      stores, [&](const record::Store& each) { return each.latest_run(plan).has_value(); });
  return named ? plan : measure::plan_name(plan);
}

core::ExitCode write_tables(const ExportArguments& arguments) {
  std::vector<record::Store> stores;
  for (const std::string& file : arguments.stores) {
    require_store(file);
    stores.emplace_back(file, record::Store::Mode::read).require_whole();
  }
  std::vector<const record::Store*> all(stores.size());
  std::ranges::transform(stores, all.begin(), [](const record::Store& each) { return &each; });
  core::require_writable(arguments.out);
  const report::ExportedRows rows = report::export_tables(
      all, {.plan = plan_in(stores, arguments.plan),
            .folder = arguments.out,
            .made_by = "triptych " + version(),
            .begins = [](const record::Run& run) { say("{} of {}\n", run.id, run.plan); }});
  if (arguments.json) {
    print({{"folder", arguments.out}, {"rows", rows}}, 1);
    return core::ExitCode::pass;
  }
  for (const auto& [table, count] : rows) put("{}/{}.csv: {} rows\n", arguments.out, table, count);
  put("{}/dictionary.json: the meaning and unit of each column\n", arguments.out);
  return core::ExitCode::pass;
}

}  // namespace

void add_export_command(Commands& commands) {
  auto [command, arguments] = commands.add(
      "export", "Write stores as CSV tables, with a dictionary of their columns", write_tables);
  command.add_option("STORE", arguments.stores, "SQLite files")->required();
  command.add_option("--out", arguments.out, "Folder for the tables")->required();
  command.add_option("--plan", arguments.plan,
                     "Only this plan: SUITE/PLAN or the YAML file, as it was run (default: all)");
  command.add_flag("--json", arguments.json, "Print the number of rows of each table as JSON");
  add_example(command, "triptych export results.sqlite --out tables");
}

}  // namespace triptych::app
