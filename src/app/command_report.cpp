#include <fmt/format.h>

#include "app/arguments.hpp"
#include "app/paths.hpp"
#include "app/registry.hpp"
#include "app/terminal.hpp"
#include "app/verdicts.hpp"
#include "core/output_files.hpp"
#include "report/exports/benchmark_json.hpp"

namespace triptych::app {
namespace {

struct ReportArguments {
  std::string store = default_store;
  std::string baselines = default_baselines().string();
  std::string out = "report.html";
  std::string benchmark_json;
};

// Checks that the file can be written. This is called for both output files before anything is
// written, so that either both files are written or neither.
void require_file(std::string_view option, const std::string& file) {
  if (file.empty()) return;
  if (std::filesystem::is_directory(file)) {
    throw core::InputError(fmt::format("{} {} is a folder; name a file in it", option, file));
  }
  core::require_writable_file(file);
}

core::ExitCode write_report(const ReportArguments& arguments) {
  core::refuse_overwriting(
      {{"--store", arguments.store}},
      {{"--out", arguments.out}, {"--benchmark-json", arguments.benchmark_json}});
  const Registry registry = make_registry();
  require_file("--out", arguments.out);
  require_file("--benchmark-json", arguments.benchmark_json);
  record::Store store = open_to_judge(arguments.store);
  measure::Truths truths(registry.find_suite(), store);
  if (store.runs().empty()) {
    throw core::NotSupported(arguments.store +
                             " contains no runs; measure first with `triptych run`");
  }
  core::write_text(arguments.out, page_of(store, truths, arguments.baselines));
  if (!arguments.benchmark_json.empty()) {
    core::write_text(arguments.benchmark_json, report::benchmark_json(store, latest_runs(store)));
  }
  print_out("{}\n", arguments.out);
  if (!arguments.benchmark_json.empty()) print_out("{}\n", arguments.benchmark_json);
  return core::ExitCode::pass;
}

}  // namespace

void add_report_command(Commands& commands) {
  auto [command, arguments] = commands.add(
      "report", "Write a self-contained HTML report on the results in a store", write_report);
  add_example(command, "triptych report --store results.sqlite --out report.html");
  command.add_option("--store", arguments.store, "SQLite file that contains the results")
      ->capture_default_str();
  command.add_option("--out", arguments.out, "The HTML file to write")->capture_default_str();
  add_baselines_option(command, arguments.baselines);
  command.add_option(
      "--benchmark-json", arguments.benchmark_json,
      "Also write the latest run of every plan to this file, as Google Benchmark JSON");
}

}  // namespace triptych::app
