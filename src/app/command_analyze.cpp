#include <fmt/format.h>

#include <memory>
#include <set>

#include "analysis/tables.hpp"
#include "app/arguments.hpp"
#include "app/paths.hpp"
#include "core/json_text.hpp"
#include "record/store.hpp"
#include "report/analysis_page.hpp"

namespace triptych::app {
namespace {

struct AnalyzeArguments {
  std::string plan;
  std::vector<std::string> stores{"triptych.sqlite"};
  std::string out;
  std::string clock = "auto";
  std::vector<std::string> references;
  std::uint64_t seed = 1;
  bool json = false;
};

// Every record of the stores, or of those of one plan.
std::vector<analysis::Source> sources_of(const AnalyzeArguments& arguments) {
  std::vector<analysis::Source> sources;
  std::set<std::string> plans;
  for (const std::string& file : arguments.stores) {
    require_store(file);
    const record::Store store(file, record::Store::Mode::read);
    store.require_whole();
    for (const record::Run& run : store.runs()) {
      plans.insert(run.plan);
      if (!arguments.plan.empty() && run.plan != arguments.plan) continue;
      std::map<std::string, record::Device> devices;
      for (const auto& entry : store.devices(run.id)) devices[entry.device.id] = entry.device;
      for (record::Record& each : store.records(run.id)) {
        sources.push_back({file, run, devices.at(each.device), std::move(each)});
      }
    }
  }
  if (sources.empty()) {
    throw core::NotSupported(
        fmt::format("no records{} to analyze; plans in the stores: {}",
                    arguments.plan.empty() ? std::string() : " of " + arguments.plan,
                    plans.empty() ? "none" : fmt::format("{}", fmt::join(plans, ", "))));
  }
  return sources;
}

analysis::Request request_of(const AnalyzeArguments& arguments) {
  analysis::Request request{.references = {}, .seed = arguments.seed};
  for (const auto& [factor, levels] : parse_overrides(arguments.references, "--reference")) {
    if (levels.size() != 1) {
      throw core::InputError(fmt::format("--reference {}: expected one level", factor));
    }
    request.references[factor] = levels.front();
  }
  return request;
}

void write_files(const std::filesystem::path& folder,
                 const std::vector<analysis::SuiteAnalysis>& analyses) {
  require_writable(folder);
  write_text(folder / "analysis.json", core::json_text(analysis::to_json(analyses), 1) + '\n');
  write_text(folder / "analysis.html", report::analysis_page(analyses));
  for (const analysis::SuiteAnalysis& each : analyses) {
    for (const analysis::Table& table : analysis::tables(each)) {
      write_text(folder / fmt::format("{}_{}.csv", each.dataset.suite, table.name),
                 analysis::csv(table));
    }
  }
}

std::string number_text(const std::optional<double>& value) {
  return value ? fmt::format("{:.3f}", *value) : "–";
}

void print_prediction(const analysis::Prediction& prediction) {
  fmt::print(
      "  R² on held-out data: lines per structure {} ({}…{} over data sets), random forest "
      "{} ({} held out; {} of {} structures had too few samples for a line)\n",
      number_text(prediction.line_mean), number_text(prediction.line_least),
      number_text(prediction.line_largest), number_text(prediction.forest_on_all),
      prediction.held_out, prediction.structures_left_out, prediction.structures);
}

void print_summary(const analysis::SuiteAnalysis& each) {
  fmt::print("{}: {} configurations on their devices, {} time\n", each.dataset.suite,
             each.dataset.observations.size(), each.dataset.clock);
  for (const std::string& note : each.dataset.notes) fmt::print("  {}\n", note);
  if (!each.dataset.duplicates.empty()) {
    const analysis::Duplicate& first = each.dataset.duplicates.front();
    fmt::print("  {} measured more than once, the latest taken; first: {} on {}, {} over {}\n",
               each.dataset.duplicates.size(), first.configuration, first.device, first.taken,
               first.dropped);
  }
  for (const analysis::Distribution& of : each.distributions) {
    fmt::print(
        "  {} ({} time, {} samples): log-normal D = {:.3f}, p = {:.2g}, Lilliefors p = "
        "{:.3g}\n",
        of.of, of.clock, of.scope.samples, of.ks_d, of.ks_p, of.lilliefors_p);
  }
  for (const analysis::Box& box : each.boxes) {
    fmt::print(
        "  r between levels of {}: mean {:.3f}, {:.3f}…{:.3f} ({} pairs of {} levels, {} "
        "samples)\n",
        box.factor, box.mean, box.quartiles.minimum, box.quartiles.maximum, box.cells, box.levels,
        box.samples);
  }
  if (each.prediction) print_prediction(*each.prediction);
  for (const analysis::PathTest& path : each.path_tests) {
    fmt::print(
        "  {} against all views: D = {:.3f}, p = {:.2g} ({} of {} samples); random samples "
        "rejected {} of {}, random views {} of {}\n",
        path.path, path.test.d, path.test.p, path.samples, path.all_samples,
        path.of_samples.rejected, path.of_samples.subsets, path.of_views.rejected,
        path.of_views.subsets);
  }
  for (const analysis::Stack& stack : each.stacks) {
    fmt::print("  r along {}: mean {:.3f}, least {:.3f} ({} sizes)\n", stack.name, stack.box.mean,
               stack.box.quartiles.minimum, stack.box.levels);
  }
  for (const analysis::LeftOut& left : each.left_out) {
    fmt::print("  left out: {}: {}\n", left.analysis, left.reason);
  }
}

core::ExitCode analyze(const AnalyzeArguments& arguments) {
  const analysis::Request request = request_of(arguments);
  const analysis::ClockChoice clock = analysis::clock_choice(arguments.clock);
  std::vector<analysis::SuiteAnalysis> analyses;
  bool nothing = true;
  for (analysis::Dataset& dataset : analysis::join(sources_of(arguments), clock)) {
    analyses.push_back(analysis::analyze(std::move(dataset), request));
    nothing = nothing && analyses.back().empty();
  }
  if (arguments.json) {
    fmt::print("{}\n", core::json_text(analysis::to_json(analyses), 1));
  } else {
    for (const analysis::SuiteAnalysis& each : analyses) print_summary(each);
  }
  if (!arguments.out.empty()) write_files(arguments.out, analyses);
  return nothing ? core::ExitCode::cannot_judge : core::ExitCode::pass;
}

}  // namespace

void add_analyze_command(Commands& commands) {
  auto arguments = std::make_shared<AnalyzeArguments>();
  CLI::App* command =
      commands.add("analyze", "Distributions, correlations, speed-ups and predictions from records",
                   [arguments] { return analyze(*arguments); });
  command->add_option("PLAN", arguments->plan,
                      "SUITE/PLAN as it was run (default: all in the stores, joined by suite)");
  command->add_option("--store", arguments->stores, "SQLite file (repeatable)")
      ->capture_default_str();
  command->add_option("--out", arguments->out,
                      "Folder for analysis.json, analysis.html and one CSV file per table");
  command
      ->add_option("--clock", arguments->clock,
                   "auto, device or wall; auto: device where every record has one that is trusted")
      ->capture_default_str();
  command->add_option("--reference", arguments->references,
                      "FACTOR=LEVEL: what speed-ups are relative to (repeatable)");
  command->add_option("--seed", arguments->seed, "Of everything that draws")->capture_default_str();
  command->add_flag("--json", arguments->json, "Print the whole analysis as JSON");
}

}  // namespace triptych::app
