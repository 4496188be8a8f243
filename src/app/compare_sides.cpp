#include "app/compare_sides.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "app/registry.hpp"
#include "app/terminal.hpp"
#include "comparison/comparison.hpp"
#include "core/exit_code.hpp"
#include "core/output_files.hpp"
#include "core/quoting.hpp"
#include "core/temporary_folder.hpp"
#include "measure/protocol/injected_fault.hpp"
#include "measure/system/environment.hpp"
#include "measure/system/process.hpp"
#include "measure/worker/own_program.hpp"
#include "record/short_name.hpp"
#include "report/exports/comparison_json.hpp"
#include "report/screen/comparison_screen.hpp"
#include "report/screen/progress_log.hpp"
#include "report/words/comparison.hpp"

namespace triptych::app {
namespace {

namespace fs = std::filesystem;

// Prints the progress of a comparison. If stderr is not a terminal, prints one line per stage, and
// from time to time a line that shows that the program is still running.
class ComparisonPrinter {
 public:
  explicit ComparisonPrinter(bool verbose) : verbose_(verbose) {}

  void print(const comparison::ComparisonProgress& progress) {
    if (progress.loading) return show_loading(*progress.loading);
    const std::string stage = report::words::stage_of(progress);
    const bool new_stage = std::exchange(stage_, stage) != stage;
    if (!stderr_is_terminal() && !verbose_ && !new_stage && !heartbeat_.due()) return;
    const auto seconds = progress.left.count();
    const std::string left =
        seconds > 0 ? ", at most " + report::rounded_duration(progress.left) + " left" : "";
    show_progress("{}/{} {}: {}{}", progress.done, progress.total, stage,
                  record::short_name(progress.configuration), left);
  }

 private:
  bool verbose_;
  std::string stage_;
  report::Heartbeat heartbeat_;
};

// Returns a default plan of the suite that counts instructions. Returns "" if a side is not a CPU
// device, because instructions are counted only on CPUs, or if the plan already counts them.
std::string exact_plan(const measure::Plan& plan, const comparison::ComparisonResult& result,
                       const Registry& registry) {
  if (plan.counted() || result.a.cpu_features.empty() || result.b.cpu_features.empty()) return {};
  for (const std::string& each : default_plans) {
    const measure::Plan other = measure::load_plan(each, {}, registry.find_suite());
    if (other.suite == plan.suite && other.counted()) return each;
  }
  return {};
}

report::ComparisonCommand command_of(const ComparisonRequest& request, const std::string& typed,
                                     const measure::Plan& plan) {
  report::ComparisonCommand command{.plan = typed,
                                    .sides = request.sides,
                                    .varied = plan.varied,
                                    .base = request.base,
                                    .verbose = request.verbose};
  for (const std::string& each : request.faults)
    command.sides += " --inject " + core::shell_quoted(each);
  // If --set gives a factor a single level, the factor no longer varies in the plan, but the
  // printed commands must still contain it.
  for (const auto& [factor, values] : request.choice.overrides()) {
    if (std::ranges::find(command.varied, factor) == command.varied.end()) {
      command.varied.push_back(factor);
    }
  }
  return command;
}

struct FinishedComparison {
  comparison::ComparisonResult result;
  report::ComparisonCommand command;
};

class Comparer {
 public:
  Comparer(const Registry& registry, const std::string& store)
      : registry_(registry),
        store_(store.empty() ? (folder_.emplace().path() / "compared.sqlite").string() : store,
               record::Store::Mode::append),
        truths_(registry.find_suite(), store_) {
    store_.require_whole();  // a damaged store could contain wrong reference images
  }

  [[nodiscard]] FinishedComparison compare(const ComparisonRequest& request,
                                           const std::string& typed, measure::Plan plan) {
    comparison::ComparisonOptions options{
        .plan = std::move(plan),
        .a = request.a,
        .b = request.b,
        .faults = measure::parse_faults(request.faults),
        .limit = std::chrono::seconds(request.limit_s),
        .seed = request.seed,
        .times = request.times,
    };
    for (const measure::InjectedFault& each : options.faults) measure::check_fault(each.fault);
    if (request.budget_s > 0) options.budget = std::chrono::seconds(request.budget_s);
    ComparisonPrinter printer(request.verbose);
    comparison::ComparisonResult result = comparison::compare(
        options, registry_.suite(options.plan.suite), store_, truths_,
        [&](const comparison::ComparisonProgress& progress) { printer.print(progress); });
    clear_line();
    report::ComparisonCommand command = command_of(request, typed, options.plan);
    command.exact_plan = exact_plan(options.plan, result, registry_);
    return {std::move(result), std::move(command)};
  }

 private:
  const Registry& registry_;
  std::optional<core::TemporaryFolder> folder_;
  record::Store store_;
  measure::Truths truths_;
};

bool is_program(const std::string& file) {
  return ::access(file.c_str(), X_OK) == 0 && fs::is_regular_file(file);
}

void print_results(const std::vector<FinishedComparison>& all, bool json) {
  if (json) {
    core::Json found = core::Json::array();
    for (const FinishedComparison& each : all)
      found.push_back(report::to_json(each.result, each.command));
    return print(found.size() == 1 ? found.front() : found);
  }
  for (const FinishedComparison& each : all)
    print_lines(report::screen_of(each.result, each.command) + "\n");
  if (all.size() == 1) return;
  for (const FinishedComparison& each : all) {
    print_out("{:<16} {:<16} {}\n", each.result.b.id, each.command.plan,
              report::words::headline(each.result));
  }
}

}  // namespace

const std::vector<std::string> default_plans{"volume/quick", "particles/quick", "volume/cost",
                                             "particles/cost"};

core::ExitCode compare_and_print(const std::vector<ComparisonRequest>& comparisons, bool json) {
  const Registry registry = make_registry();
  std::vector<FinishedComparison> all;
  core::ExitCode code = core::ExitCode::pass;
  for (const ComparisonRequest& each : comparisons) {
    if (!each.store.empty()) core::require_writable(fs::path(each.store).parent_path());
    Comparer comparer(registry, each.store);
    for (const std::string& typed : each.plans.empty() ? default_plans : each.plans) {
      measure::Plan plan = each.choice.load(typed, registry.find_suite());
      if (plan.configurations.empty() && each.choice.selects()) continue;
      try {
        all.push_back(comparer.compare(each, typed, std::move(plan)));
      } catch (const measure::Interrupted&) {
        throw core::Error("interrupted; a comparison cannot be resumed, so start it again");
      }
      code = core::worse_of(code, all.back().result.exit_code());
    }
  }
  if (all.empty() && !comparisons.empty()) throw nothing_selected(comparisons.front().choice);
  print_results(all, json);
  return code;
}

std::vector<std::string> worker_of(const std::string& option, const std::string& program) {
  if (!is_program(program)) {
    throw core::InputError(
        fmt::format("{} {}: this file is not an executable program", option, program));
  }
  const std::string file = fs::absolute(program).string();
  // The version need not be at the beginning of the output, because a driver may have printed
  // something before it.
  const std::string version_output = measure::output_of({file, "--version"}).value_or("");
  if (("\n" + version_output).find("\ntriptych ") == std::string::npos) {
    throw core::InputError(fmt::format(
        "{} {}: this program is not a build of triptych, judging by its --version output", option,
        program));
  }
  return measure::worker_command(file);
}

std::vector<ComparisonRequest> comparisons_with_base(const std::string& base,
                                                     const std::vector<std::string>& devices) {
  const bool program = is_program(base);
  const std::vector<std::string> own = measure::worker_command();
  std::vector<std::string> command = own;
  std::vector<std::string> environment;
  if (program) {
    command = worker_of("--base", base);
  } else if (base.find('=') == std::string::npos) {
    throw core::InputError(
        fmt::format("--base {}: expected an executable program or NAME=VALUE", base));
  } else {
    environment = measure::parse_environment(base, "--base " + base);
  }
  std::vector<ComparisonRequest> comparisons;
  for (const std::string& device : devices) {
    const std::string a = program ? device : device + "," + base;
    std::string sides =
        fmt::format("--a {} --b {}", core::shell_quoted(a), core::shell_quoted(device));
    if (program) sides += " --a-program " + core::shell_quoted(base);
    comparisons.push_back({.plans = {},
                           .a = {device, command, environment},
                           .b = {device, own},
                           .sides = sides,
                           .base = true});
  }
  return comparisons;
}

}  // namespace triptych::app
