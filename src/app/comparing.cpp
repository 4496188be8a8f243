#include "app/comparing.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>

#include "app/judging.hpp"
#include "app/loading.hpp"
#include "app/paths.hpp"
#include "app/registry.hpp"
#include "app/saying.hpp"
#include "app/truth.hpp"
#include "comparison/comparison.hpp"
#include "comparison/text.hpp"
#include "core/exit_code.hpp"
#include "core/json.hpp"
#include "core/json_text.hpp"
#include "core/quoting.hpp"
#include "core/temporary_folder.hpp"
#include "measure/protocol/injected_fault.hpp"

namespace triptych::app {
namespace {

// Whether the text goes on with NAME=: a comma before it ends the value before.
bool begins_a_variable(std::string_view text) {
  const auto letter = [](char c) {
    return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
  };
  if (text.empty() || !letter(text.front())) return false;
  const auto* end = std::ranges::find_if_not(
      text, [&](char c) { return letter(c) || std::isdigit(static_cast<unsigned char>(c)); });
  return end != text.end() && *end == '=';
}

// A line that rewrites itself on a terminal, a line per step elsewhere.
void show(const comparison::ComparisonProgress& progress) {
  if (progress.loading) return show_loading(*progress.loading);
  static const bool terminal = ::isatty(STDERR_FILENO) == 1;
  if (terminal) say("\r\033[K");
  say("{}/{} {}: {}, left at most {} s", progress.done, progress.total, progress.stage,
      progress.configuration, progress.left.count());
  if (!terminal) say("\n");
}

comparison::ComparisonCommand command_of(const Comparing& comparing, const std::string& typed,
                                         const measure::Plan& plan) {
  comparison::ComparisonCommand command{
      .plan = typed, .sides = comparing.sides, .varied = plan.varied};
  for (const std::string& each : comparing.faults)
    command.sides += " --inject " + core::shell_quoted(each);
  // What the command line set to one value is no longer varied, but must be said again.
  for (const auto& [factor, values] : parse_overrides(comparing.choice.set)) {
    if (std::ranges::find(command.varied, factor) == command.varied.end()) {
      command.varied.push_back(factor);
    }
  }
  return command;
}

struct Told {
  comparison::ComparisonResult result;
  comparison::ComparisonCommand command;
};

class Comparer {
 public:
  Comparer(const Registry& registry, const std::string& store)
      : registry_(registry),
        store_(store.empty() ? (folder_.emplace().path() / "compared.sqlite").string() : store,
               record::Store::Mode::append),
        truths_(registry, store_) {
    store_.require_whole();  // truths come from it
  }

  [[nodiscard]] Told compare(const Comparing& comparing, const std::string& typed) {
    comparison::ComparisonOptions options{
        .plan = comparing.choice.load(typed, registry_.find_suite()),
        .a = comparing.a,
        .b = comparing.b,
        .faults = parse_faults(comparing.faults),
        .limit = std::chrono::seconds(comparing.limit_s),
        .seed = comparing.seed,
        .times = comparing.times,
    };
    for (const measure::InjectedFault& each : options.faults) measure::check_fault(each.fault);
    if (comparing.budget_s > 0) options.budget = std::chrono::seconds(comparing.budget_s);
    comparison::ComparisonResult result = comparison::compare(
        options, registry_.suite(options.plan.suite), store_, known_truth(truths_), show);
    if (::isatty(STDERR_FILENO) == 1) say("\r\033[K");
    return {std::move(result), command_of(comparing, typed, options.plan)};
  }

 private:
  const Registry& registry_;
  std::optional<core::TemporaryFolder> folder_;
  record::Store store_;
  Truths truths_;
};

void tell(const std::vector<Told>& all, bool json) {
  if (json) {
    core::Json found = core::Json::array();
    for (const Told& each : all) found.push_back(to_json(each.result, each.command));
    fmt::print("{}\n", core::json_text(found.size() == 1 ? found.front() : found, 2));
    return;
  }
  for (const Told& each : all) fmt::print("{}\n", to_text(each.result, each.command));
  if (all.size() == 1) return;
  for (const Told& each : all) {
    fmt::print("{:<16} {:<16} {}\n", each.result.b.id, each.command.plan,
               comparison::headline(each.result));
  }
}

}  // namespace

const std::vector<std::string> main_job{"volume/quick", "particles/quick", "volume/cost",
                                        "particles/cost"};

core::ExitCode compare_and_tell(const std::vector<Comparing>& comparisons, bool json) {
  const Registry registry = make_registry();
  std::vector<Told> all;
  core::ExitCode code = core::ExitCode::pass;
  for (const Comparing& each : comparisons) {
    if (!each.store.empty()) {
      require_writable(std::filesystem::path(each.store).parent_path());
    }
    Comparer comparer(registry, each.store);
    for (const std::string& typed : each.plans.empty() ? main_job : each.plans) {
      try {
        all.push_back(comparer.compare(each, typed));
      } catch (const measure::Interrupted&) {
        throw core::Error("interrupted; a comparison keeps nothing, begin it again");
      }
      code = core::worse_of(code, all.back().result.exit_code());
    }
  }
  tell(all, json);
  return code;
}

std::vector<Comparing> against_base(const std::string& base,
                                    const std::vector<std::string>& devices) {
  const bool program = ::access(base.c_str(), X_OK) == 0 && std::filesystem::is_regular_file(base);
  const std::vector<std::string> own{own_program(), "worker", "--device"};
  std::vector<std::string> command = own;
  std::vector<std::string> environment;
  if (program) {
    command.front() = std::filesystem::absolute(base).string();
  } else {
    environment = parse_environment(base, "--base " + base);
  }
  std::vector<Comparing> comparisons;
  for (const std::string& device : devices) {
    const std::string a = program ? device : device + "," + base;
    std::string sides =
        fmt::format("--a {} --b {}", core::shell_quoted(a), core::shell_quoted(device));
    if (program) sides += " --a-program " + core::shell_quoted(base);
    comparisons.push_back(
        {.plans = {}, .a = {device, command, environment}, .b = {device, own}, .sides = sides});
  }
  return comparisons;
}

std::vector<std::string> parse_environment(std::string_view text, const std::string& where) {
  std::vector<std::string> environment;
  for (std::string_view rest = text;;) {
    if (!begins_a_variable(rest)) {
      throw core::InputError(fmt::format("{}: expected NAME=VALUE, got '{}'", where, rest));
    }
    std::size_t end = rest.find(',');
    while (end != std::string_view::npos && !begins_a_variable(rest.substr(end + 1))) {
      end = rest.find(',', end + 1);
    }
    environment.emplace_back(rest.substr(0, end));
    if (end == std::string_view::npos) return environment;
    rest.remove_prefix(end + 1);
  }
}

}  // namespace triptych::app
