// The `merge` command combines the measurements of several machines into one store, as if one
// machine had measured everything.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "app/arguments.hpp"
#include "app/terminal.hpp"
#include "core/output_files.hpp"
#include "record/merge/merge.hpp"

namespace triptych::app {
namespace {

struct MergeArguments {
  std::vector<std::string> stores;
  std::string out;
  bool check = false;
  std::vector<std::string> plans;  // plans that each store must contain
};

void print_left_out(const record::RecordCounts& counts) {
  if (counts.repeated > 0) {
    print_out("  {} records occur in several stores; one copy of each record was kept\n",
              counts.repeated);
  }
  if (counts.injected > 0) {
    print_out("  {} records with an injected fault were replaced by records without one\n",
              counts.injected);
  }
  if (counts.remeasured > 0) {
    print_out(
        "  {} failed or skipped records were replaced by measured records from another store\n",
        counts.remeasured);
  }
  if (counts.not_chosen > 0) {
    print_out(
        "  {} records were dropped, because another store has a different record for the same "
        "configuration and device; the record with the lower seal (hash) was kept\n",
        counts.not_chosen);
  }
}

void print_summary(const record::MergeResult::Plan& plan, const std::string& out) {
  print_out("{}: run {} in {}: {} configurations\n", plan.run.plan, plan.run.id, out,
            plan.run.configurations);
  for (const auto& [device, records] : plan.counts.records) {
    print_out("  {}: {} records{}\n", device, records,
              records < plan.run.configurations
                  ? fmt::format(", {} missing", plan.run.configurations - records)
                  : "");
  }
  print_left_out(plan.counts);
}

std::vector<std::string> gaps_in(const record::Store& store,
                                 const std::vector<std::string>& plans) {
  std::vector<std::string> gaps;
  for (const std::string& each : plans) {
    const std::string name = measure::plan_name(each);
    if (!store.latest_run(name)) gaps.push_back(name + ": no run of this plan");
  }
  for (const record::Gap& gap : record::gaps_of(store)) {
    if (gap.configurations == 0) {
      gaps.push_back(gap.plan + ": the shard contains no configurations");
      continue;
    }
    gaps.push_back(fmt::format(
        "{}{}: records for {} of {} configurations{}{}", gap.plan,
        gap.device.empty() ? "" : " on " + gap.device, gap.records, gap.configurations,
        gap.missing.empty() ? "" : "; missing: ", gap.missing.empty() ? "" : gap.missing.front()));
    if (gap.missing.size() > 1) gaps.back() += ", …";
  }
  if (gaps.empty() && store.runs().empty()) gaps.emplace_back("contains no runs");
  return gaps;
}

// Returns one line for each gap in the measurements of any of the stores.
std::string all_gaps(const MergeArguments& arguments) {
  std::string lines;
  for (const std::string& file : arguments.stores) {
    const record::Store store(file, record::Store::Mode::read);
    for (const std::string& gap : gaps_in(store, arguments.plans)) {
      lines += fmt::format("{}: {}\n", file, gap);
    }
  }
  return lines;
}

bool has_run(const std::string& file) {
  return !record::Store(file, record::Store::Mode::read).runs().empty();
}

core::ExitCode merge(const MergeArguments& arguments) {
  if (arguments.check) {
    const std::string gaps = all_gaps(arguments);
    print_lines(gaps);
    return gaps.empty() ? core::ExitCode::pass : core::ExitCode::cannot_judge;
  }
  if (arguments.out.empty()) throw core::InputError("--out is required; name the store to write");
  if (std::ranges::none_of(arguments.stores, has_run)) {
    throw core::NotSupported(
        fmt::format("there is nothing to merge, because no store contains a run: {}",
                    fmt::join(arguments.stores, ", ")));
  }
  core::require_writable(std::filesystem::path(arguments.out).parent_path());
  // Everything that can fail is done before the merged store is created.
  const std::string gaps = all_gaps(arguments);
  // Shows the number of merged records on a terminal, at most once every 200 milliseconds.
  const auto count = [last =
                          std::chrono::steady_clock::time_point()](std::uint64_t records) mutable {
    const auto now = std::chrono::steady_clock::now();
    if (!stderr_is_terminal() || now - last < std::chrono::milliseconds(200)) return;
    last = now;
    show_progress("merged {} records", records);
  };
  const record::MergeResult result = record::merge_stores(
      {arguments.stores.begin(), arguments.stores.end()}, arguments.out, count);
  clear_line();
  for (const record::MergeResult::Plan& each : result.plans) print_summary(each, arguments.out);
  if (result.older_runs > 0) {
    print_out(
        "{} older runs were left out, because each store contributes only its latest run of a "
        "plan\n",
        result.older_runs);
  }
  // A gap in one shard (part of a plan) is not necessarily a gap in the merged run, because another
  // shard may contain the configuration.
  if (!gaps.empty()) {
    print_lines(gaps);
    print_out(
        "The records listed above are also missing from {} unless another store contains them\n",
        arguments.out);
  }
  return core::ExitCode::pass;
}

}  // namespace

void add_merge_command(Commands& commands) {
  auto [command, arguments] = commands.add(
      "merge", "Combine the stores of several shards, hosts or devices into one store", merge);
  command.add_option("STORE", arguments.stores, "Stores written by `triptych run`")->required();
  add_example(command, "triptych merge shard-*.sqlite --out all.sqlite");
  CLI::Option* out =
      command.add_option("--out", arguments.out, "Store to write; it must not exist yet");
  CLI::Option* check = command
                           .add_flag("--check", arguments.check,
                                     "Do not merge; list the stores that lack records of their "
                                     "shard, and exit with code 2 if there are any")
                           ->excludes(out);
  command
      .add_option("--plan", arguments.plans,
                  "With --check: also list stores that contain no run of this plan (repeatable)")
      ->needs(check);
}

}  // namespace triptych::app
