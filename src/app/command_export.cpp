#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <optional>

#include "accuracy/requested_error.hpp"
#include "app/arguments.hpp"
#include "app/registry.hpp"
#include "app/terminal.hpp"
#include "app/verdicts.hpp"
#include "app/version.hpp"
#include "core/output_files.hpp"
#include "measure/plan/plan.hpp"
#include "measure/truth/truths.hpp"
#include "record/short_name.hpp"
#include "record/store.hpp"
#include "report/exports/export_tables.hpp"

namespace triptych::app {
namespace {

struct ExportArguments {
  std::vector<std::string> stores;
  std::string out;
  std::string plan;
  bool errors = false;
  bool json = false;
};

// Computes the errors of images against their reference images and their limit images (with exact
// ray integrals). Reference images cannot be saved in a read-only store, so they are drawn again
// for each export from such a store.
class ImageErrors {
 public:
  explicit ImageErrors(const std::vector<std::string>& files) : registry_(make_registry()) {
    for (const std::string& file : files) {
      record::Store& store = stores_.emplace_back(open_to_judge(file));
      for (const record::Run& run : store.runs()) {
        truths_.emplace(run.id, measure::Truths(registry_.find_suite(), store));
      }
    }
  }

  std::vector<report::ImageError> of(const record::Record& record) {
    const auto truths = truths_.find(record.run);
    if (record.image.empty() || truths == truths_.end()) return {};
    std::vector<report::ImageError> errors;
    try {
      const core::Image image = truths->second.image_of(record);
      add("reference", truths->second.of(record).truth, image, errors);
      if (const accuracy::LimitImage* limit = truths->second.limit_of(record)) {
        add("limit", limit->image, image, errors);
      }
    } catch (const core::Error& error) {
      print_err("triptych: {}: cannot compute the errors of this image: {}\n",
                record::short_name(record), error.what());
    }
    return errors;
  }

 private:
  static void add(const std::string& against, const core::Image& right, const core::Image& image,
                  std::vector<report::ImageError>& errors) {
    const accuracy::ErrorsByMetric all = accuracy::errors_against(right, image);
    for (const accuracy::Metric metric : accuracy::all_metrics) {
      const double error = all.of(metric);
      if (std::isnan(error)) continue;  // the images cannot be compared
      errors.push_back({against, std::string(accuracy::name_of(metric)), error});
    }
  }

  Registry registry_;
  std::deque<record::Store> stores_;
  std::map<std::string, measure::Truths> truths_;  // by run id
};

// Returns the name by which the stores identify the plan. `plan` is either that name or the YAML
// file that was given to `run`.
std::string stored_plan_name(const std::vector<record::Store>& stores, const std::string& plan) {
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
  report::ExportRequest request{.plan = stored_plan_name(stores, arguments.plan),
                                .folder = arguments.out,
                                .made_by = "triptych " + version(),
                                .on_run = [](const record::Run& run) {
                                  print_err("exporting run {} of the plan {}\n", run.id, run.plan);
                                }};
  std::optional<ImageErrors> errors;
  if (arguments.errors) {
    errors.emplace(arguments.stores);
    request.errors = [&](const record::Record& record) { return errors->of(record); };
  }
  const report::ExportedRows rows = report::export_tables(all, request);
  if (arguments.json) {
    print({{"folder", arguments.out}, {"rows", rows}}, 1);
    return core::ExitCode::pass;
  }
  for (const auto& [table, count] : rows)
    print_out("{}/{}.csv: {} rows\n", arguments.out, table, count);
  print_out("{}/dictionary.json: the meaning and unit of each column\n", arguments.out);
  return core::ExitCode::pass;
}

}  // namespace

void add_export_command(Commands& commands) {
  auto [command, arguments] = commands.add(
      "export", "Export stores as CSV tables, with a dictionary of the columns", write_tables);
  command.add_option("STORE", arguments.stores, "Stores to export (SQLite files)")->required();
  command.add_option("--out", arguments.out, "Write the CSV files to this folder")->required();
  command.add_option("--plan", arguments.plan,
                     "Export only this plan, named as in the `run` command: SUITE/PLAN or a YAML "
                     "file (default: all plans)");
  command.add_flag("--errors", arguments.errors,
                   "Also write errors.csv, which contains four error metrics for each image, "
                   "relative to its reference image and to its limit image (the exact ray "
                   "integral); reference and limit images that are not in the store are rendered "
                   "first");
  command.add_flag("--json", arguments.json, "Print the number of rows in each table as JSON");
  add_example(command, "triptych export results.sqlite --out tables");
}

}  // namespace triptych::app
