#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "accuracy/image_metrics.hpp"
#include "app/arguments.hpp"
#include "app/one_frame.hpp"
#include "app/terminal.hpp"
#include "app/version.hpp"
#include "core/json_text.hpp"
#include "core/output_files.hpp"
#include "core/temporary_folder.hpp"
#include "measure/worker/listing.hpp"
#include "measure/worker/own_program.hpp"
#include "record/factor_list.hpp"
#include "record/short_name.hpp"
#include "reduction/reduce.hpp"
#include "reduction/sequence.hpp"
#include "reduction/trial.hpp"
#include "report/ci/bug_report.hpp"
#include "report/command.hpp"
#include "report/exports/frame_folder.hpp"
#include "report/words/comparison.hpp"
#include "report/words/finding.hpp"
#include "report/words/frame_title.hpp"

namespace triptych::app {
namespace {

namespace fs = std::filesystem;

constexpr int max_frames = 1000000;

struct ReduceArguments {
  FrameArguments frame = {.out = "reduced"};
  std::string against;
  std::string after;  // a plan; empty: the frame is only drawn alone
  int limit_s = 0;    // 0: derived from the duration of the first frame
  std::optional<int> frames = {};
  // Accepted, but ignored, so that the options of a `render` command also work for `reduce`, which
  // always compares with the reference image.
  bool truth = true;
};

measure::RunOptions options_of(const ReduceArguments& arguments) {
  return {.protocol = {},
          .limit = std::chrono::seconds(arguments.limit_s),
          .faults = measure::parse_faults(arguments.frame.faults),
          .worker_command = measure::worker_command(),
          .program = version()};
}

bool has_wrong_counters(const reduction::Failure& failure) {
  return failure.cause == judge::Cause::values_changed;
}

// Returns the command that reproduces the failure: `render`, except for wrong counters. These are
// found by comparison with a second device, but `render` draws on only one device, so for wrong
// counters the command is `reduce`.
std::string command_for(const OneFrame& frame, const ReduceArguments& arguments,
                        const reduction::Failure& failure, const record::Record& record,
                        const record::Device& device) {
  const bool counters = has_wrong_counters(failure);
  report::Command command{.command = counters ? "reduce" : "render",
                          .object = std::string(frame.suite.name()),
                          .device = frame.device,
                          .factors = record::parse_factor_list(record.configuration),
                          .injected = arguments.frame.faults,
                          .limit = failure.reason.limit(),
                          .more = {"--truth", "--out", "again"},
                          .environment = device.environment};
  if (counters) command.more.insert(command.more.begin(), {"--against", arguments.against});
  return report::text_of(command);
}

// Writes the reference image, the device's image (if there is one), and frame.json, which contains
// everything that another program needs to draw this frame. Returns the names of the files.
std::vector<std::string> write_frame(const OneFrame& frame, const reduction::Trial& trial,
                                     measure::Truths& truths, const fs::path& out) {
  const record::Record& record = trial.last();
  std::vector<std::string> files{"frame.json", "truth.png"};
  const core::Json json =
      report::frame_json(frame.suite.describe(record.factors), record, trial.device());
  core::write_text(out / "frame.json", core::json_text(json, 2) + "\n");
  const judge::TruthPair& pair = truths.of(record);
  if (record.image.empty()) {
    report::write_image_files(out, "truth", pair.truth);
    return files;
  }
  const core::Image image = truths.image_of(record);
  report::write_image_files(out, "image", image);
  static_cast<void>(report::write_difference(out, image, pair));
  files.insert(files.end(), {"image.png", "difference.png"});
  return files;
}

// Draws the frame once more, in one process, and writes all of the driver's input to the folder
// "dump": device code, options, buffers and a C program. If there is an image, pixel.txt contains
// the history of one of its pixels: the first pixel that shows a wrong particle or a wrong depth
// or, if there is none, the pixel with the largest ratio of error to bound. If the driver crashes
// before it receives the input, nothing is written. If the frame hangs, its input has already been
// written when the process is killed. `limit` is the frame's time limit.
std::vector<std::string> write_dump(const OneFrame& frame, const ReduceArguments& arguments,
                                    const reduction::Trial& trial, measure::Truths& truths,
                                    std::optional<std::chrono::seconds> limit,
                                    const fs::path& out) {
  const record::Record& record = trial.last();
  const fs::path folder = out / "dump";
  std::vector<std::string> command{measure::own_program(),
                                   "render",
                                   std::string(frame.suite.name()),
                                   "--device",
                                   frame.device,
                                   "--dump",
                                   folder.string(),
                                   "--out",
                                   folder.string()};
  for (const auto& [factor, level] : record::parse_factor_list(record.configuration)) {
    command.insert(command.end(), {"--set", factor + "=" + record::escaped(level)});
  }
  for (const std::string& fault : arguments.frame.faults) {
    command.insert(command.end(), {"--inject", fault});
  }
  if (!record.image.empty()) {
    const judge::TruthPair& pair = truths.of(record);
    const accuracy::ImageComparison compared =
        accuracy::compare(truths.image_of(record), pair.truth, pair.bound);
    const bool surface = compared.first_wrong.x >= 0;
    const int x = surface ? compared.first_wrong.x : compared.worst.x;
    const int y = surface ? compared.first_wrong.y : compared.worst.y;
    if (x >= 0) command.insert(command.end(), {"--pixel", fmt::format("{},{}", x, y)});
  }
  if (limit) {
    command.insert(command.begin(),
                   {"timeout", "--signal=KILL", fmt::to_string(limit->count() + 2)});
  }
  static_cast<void>(measure::output_of(command));
  std::vector<std::string> files;
  if (fs::exists(folder / "what-was-given.txt")) files.emplace_back("dump");
  if (fs::exists(folder / "pixel.txt")) files.emplace_back("dump/pixel.txt");
  return files;
}

report::BugReport report_of(const OneFrame& frame, const reduction::Reduction& reduction) {
  report::BugReport report{.title = report::words::frame_title(reduction.failure, frame.device),
                           .message = report::words::text_of(reduction.failure),
                           .device = {},
                           .system = {},
                           .command = {},
                           .changes = {},
                           .factors = reduction.smallest,
                           .frames = reduction.frames,
                           .complete = reduction.complete,
                           .files = {}};
  for (const auto& [factor, from, to, number] : reduction::changed_levels(
           frame.suite, frame.plan.configurations.front(), reduction.smallest)) {
    report.changes.push_back({factor, from, to});
  }
  return report;
}

// Everything that a search needs, and the folder to which it writes its result.
struct Search {
  const ReduceArguments& arguments;
  const OneFrame& frame;
  const record::Store& store;
  measure::Truths& truths;
  reduction::Trial& trial;
  fs::path out;
};

// Completes the report about the frame that was drawn last, writes it, and prints its summary.
// `found` states in words what the search found.
core::ExitCode finish_report(const Search& search, report::BugReport report,
                             const std::string& found) {
  report.device = search.trial.device();
  report.injected = search.arguments.frame.faults;
  report.system = search.store.runs().front().system;
  for (std::string& file : write_frame(search.frame, search.trial, search.truths, search.out)) {
    report.files.push_back(std::move(file));
  }
  core::write_text(search.out / "README.md", report::markdown(report));
  print_lines(
      fmt::format("{}\n{} frames drawn; {}{}\n{}\n{}\n", report.message, report.frames, found,
                  report.complete ? "" : "; the search stopped at the limit set by --frames",
                  (search.out / "README.md").string(), report.command));
  return core::ExitCode::regression;
}

core::ExitCode reduce_frame(const Search& search, const reduction::Failure& first) {
  const auto on_step = [](const reduction::Step& step) {
    print_err("{:>4} frames drawn: {} {} → {}\n", step.frame, step.factor, step.from, step.to);
  };
  const measure::Configuration& start = search.frame.plan.configurations.front();
  const reduction::Reduction reduction =
      reduction::reduce(search.frame.suite, start, first, search.arguments.frames.value_or(500),
                        std::ref(search.trial), on_step);
  static_cast<void>(search.trial(reduction.smallest));
  report::BugReport report = report_of(search.frame, reduction);
  report.files = write_dump(search.frame, search.arguments, search.trial, search.truths,
                            reduction.failure.reason.limit(), search.out);
  report.command = command_for(search.frame, search.arguments, reduction.failure,
                               search.trial.last(), search.trial.device());
  return finish_report(search, report, report::text_of(report.changes));
}

// The configurations that a plan draws before a given frame.
class PrecedingConfigurations {
 public:
  // Throws core::InputError if the plan does not contain the frame.
  PrecedingConfigurations(const Registry& registry, const OneFrame& frame, const std::string& plan)
      : suite_(frame.suite) {
    measure::Plan whole = PlanChoice{}.load(plan, registry.find_suite());
    plan_ = whole.name;
    const std::string last = key(frame.plan.configurations.front());
    const auto found =
        std::ranges::find_if(whole.configurations, [&](const measure::Configuration& each) {
          return whole.suite == suite_.name() && key(each) == last;
        });
    if (found == whole.configurations.end()) {
      throw core::InputError(fmt::format(
          "--after {}: this plan does not contain the frame; name the plan in which it failed",
          plan));
    }
    whole.configurations.erase(found, whole.configurations.end());
    before_ = std::move(whole.configurations);
  }

  [[nodiscard]] std::size_t size() const { return before_.size(); }
  [[nodiscard]] std::vector<measure::Configuration> at(
      const reduction::Positions& positions) const {
    std::vector<measure::Configuration> chosen;
    for (const std::size_t each : positions) chosen.push_back(before_[each]);
    return chosen;
  }
  [[nodiscard]] std::string key(const measure::Configuration& configuration) const {
    return measure::configuration_key(suite_, configuration);
  }
  [[nodiscard]] std::string name(const measure::Configuration& configuration) const {
    return record::short_name(suite_.name(), plan_, key(configuration));
  }

 private:
  const measure::Suite& suite_;
  std::string plan_;
  std::vector<measure::Configuration> before_;
};

// Returns the command that draws the listed configurations in one process, and judges the images or
// the counters.
std::string command_for_sequence(const Search& search, const reduction::Failure& failure,
                                 const fs::path& list) {
  const bool counters = has_wrong_counters(failure);
  return report::text_of(
      {.command = "gate",
       .object = search.arguments.after,
       .device = search.frame.device,
       .factors = {},
       .injected = search.arguments.frame.faults,
       .limit = failure.reason.limit(),
       .more = {"--measure", "--check", counters ? "counters" : "image", "--caselist",
                list.string(), "--store", (search.out / "again.sqlite").string()},
       .environment = search.trial.device().environment});
}

// Writes and prints the sequence `before`, after which the frame has just failed.
core::ExitCode finish_sequence_report(const Search& search,
                                      const PrecedingConfigurations& preceding,
                                      const std::vector<measure::Configuration>& before,
                                      const reduction::Failure& failure, report::BugReport report) {
  const measure::Configuration& frame = search.frame.plan.configurations.front();
  const fs::path list = search.out / "sequence.txt";
  std::string keys;
  std::string found = fmt::format("the frame fails after {} of {} configurations:", before.size(),
                                  preceding.size());
  for (const measure::Configuration& each : before) {
    report.before.push_back(preceding.name(each));
    found += "\n  " + report.before.back();
    keys += preceding.key(each) + "\n";
  }
  core::write_text(list, keys + preceding.key(frame) + "\n");
  report.files = {"sequence.txt"};
  report.title = report::words::frame_title(failure, search.frame.device);
  report.message = report::words::text_of(failure);
  report.plan = search.arguments.after;
  report.factors = frame;
  report.command = command_for_sequence(search, failure, list);
  return finish_report(search, std::move(report), found);
}

// Finds the shortest sequence of configurations after which the frame fails.
core::ExitCode reduce_sequence(const Search& search, const PrecedingConfigurations& preceding) {
  const measure::Configuration& frame = search.frame.plan.configurations.front();
  std::optional<reduction::Failure> failure;
  report::BugReport report;
  const auto fails_after = [&](const reduction::Positions& positions) {
    report.frames += static_cast<int>(positions.size()) + 1;
    const auto now = search.trial.draw_after(preceding.at(positions), frame);
    if (!now || (failure && !reduction::is_same_kind(*now, *failure))) return false;
    failure = now;
    return true;
  };
  const auto on_shorter = [&](std::size_t length) {
    print_err("{:>4} frames drawn: the frame fails after {} of {} configurations\n", report.frames,
              length, preceding.size());
  };
  const auto sequence = reduction::shortest_sequence(
      preceding.size(), static_cast<std::size_t>(search.arguments.frames.value_or(max_frames)),
      fails_after, on_shorter);
  if (!sequence) {
    print_out(
        "the frame does not fail on {}, neither alone nor after the {} configurations that {} "
        "draws before it\n",
        search.frame.device, preceding.size(), search.arguments.after);
    return core::ExitCode::pass;
  }
  report.complete = sequence->complete;
  const std::vector<measure::Configuration> before = preceding.at(sequence->before);
  const auto again = search.trial.draw_after(before, frame);
  if (!again || !reduction::is_same_kind(*again, *failure)) {
    throw core::NotSupported(report::words::fails_differently(*failure, again));
  }
  return finish_sequence_report(search, preceding, before, *again, std::move(report));
}

core::ExitCode reduce(const ReduceArguments& arguments) {
  const Registry registry = make_registry();
  const OneFrame frame = choose_frame(registry, arguments.frame);
  std::optional<PrecedingConfigurations> preceding;
  if (!arguments.after.empty()) preceding.emplace(registry, frame, arguments.after);
  const fs::path out = report::prepare_reduced_folder(arguments.frame.out);
  const core::TemporaryFolder folder;
  record::Store store(folder.path() / "reduce.sqlite", record::Store::Mode::append);
  measure::Truths truths(registry.find_suite(), store);
  const std::string other = arguments.against.empty()
                                ? std::string()
                                : measure::choose_device(registry.devices({arguments.against}),
                                                         "--against", arguments.against);
  const measure::Configuration& start = frame.plan.configurations.front();
  measure::RunOptions options = options_of(arguments);
  if (arguments.limit_s == 0) {
    options.limit =
        reduction::limit_by_first_frame(frame.suite, frame.device, start, options, store);
  }
  reduction::Trial trial(frame.suite, frame.device, other, options, truths, store);
  const Search search{arguments, frame, store, truths, trial, out};
  const reduction::FirstFrames first = trial.draw_first(start);
  print_device(trial.device());
  if (!first.first_failure) {
    if (preceding) return reduce_sequence(search, *preceding);
    print_out(
        "the frame does not fail on {}, so there is nothing to reduce; if it failed in a plan, add "
        "--after PLAN\n",
        frame.device);
    return core::ExitCode::pass;
  }
  if (!first.repeats()) {
    throw core::NotSupported(
        report::words::fails_differently(*first.first_failure, first.second_failure));
  }
  print_err("{}: {}\n", frame.device, report::words::text_of(*first.second_failure));
  return reduce_frame(search, *first.second_failure);
}

}  // namespace

void add_reduce_command(Commands& commands) {
  auto [command, arguments] = commands.add(
      "reduce", "Find the smallest frame that still fails, and write the files for a bug report",
      reduce);
  arguments.frame.add_to(command);
  command.add_option("--out", arguments.frame.out, "Write the files to this folder")
      ->capture_default_str();
  command.add_option("--against", arguments.against,
                     "Assume that the counters of this device are correct, and treat any "
                     "difference from them as a failure");
  command.add_option("--after", arguments.after,
                     "If the frame does not fail alone, find the shortest sequence of this plan's "
                     "configurations after which it fails");
  command
      .add_option(
          "--limit", arguments.limit_s,
          "Treat a frame as hung after this many seconds (default: three times the duration "
          "of the first frame, but at least 20)")
      ->check(CLI::Range(1, 86400));
  command
      .add_option("--frames", arguments.frames,
                  "Draw at most this many frames (default: 500; with --after, 1000000)")
      ->check(CLI::Range(1, max_frames));
  command.add_flag("--truth", arguments.truth,
                   "Has no effect, because `reduce` always compares with the reference image; this "
                   "option exists so that a `render` command can be reused");
  add_example(command,
              "triptych reduce volume --device vulkan:lavapipe --set viewport=64 --out small");
}

}  // namespace triptych::app
