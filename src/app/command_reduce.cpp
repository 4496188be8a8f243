#include <fmt/format.h>

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
#include "reduction/reduce.hpp"
#include "reduction/trial.hpp"
#include "report/ci/bug_report.hpp"
#include "report/command.hpp"
#include "report/exports/frame_folder.hpp"
#include "report/words/comparison.hpp"
#include "report/words/finding.hpp"

namespace triptych::app {
namespace {

namespace fs = std::filesystem;

struct ReduceArguments {
  FrameArguments frame = {.out = "reduced"};
  std::string against;
  int limit_s = 0;  // 0: derived from the duration of the first frame
  int frames = 500;
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

// Returns the command that reproduces the failure: `render`, except for wrong counters. These are
// found by comparison with a second device, but `render` draws on only one device, so for wrong
// counters the command is `reduce`.
std::string command_for(const OneFrame& frame, const ReduceArguments& arguments,
                        const reduction::Failure& failure, const record::Record& record,
                        const record::Device& device) {
  const bool picture = failure.cause != judge::Cause::values_changed;
  report::Command command{.command = picture ? "render" : "reduce",
                          .object = std::string(frame.suite.name()),
                          .device = frame.device,
                          .factors = record::parse_factor_list(record.configuration),
                          .injected = arguments.frame.faults,
                          .limit = failure.reason.limit(),
                          .more = {"--truth", "--out", "again"},
                          .environment = device.environment};
  if (!picture) command.more.insert(command.more.begin(), {"--against", arguments.against});
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
    report::write_picture(out, "truth", pair.truth);
    return files;
  }
  const core::Image image = truths.picture_of(record);
  report::write_picture(out, "image", image);
  static_cast<void>(report::write_difference(out, image, pair));
  files.insert(files.end(), {"image.png", "difference.png"});
  return files;
}

// Draws the frame once more, in one process, and writes all of the driver's input to the folder
// "dump": device code, options, buffers and a C program. If there is an image, pixel.txt contains
// the history of its first wrong pixel or of its worst pixel. If the driver crashes before it
// receives the input, nothing is written. If the frame hangs, its input has already been written
// when the process is killed. `limit` is the frame's time limit.
std::vector<std::string> write_dump_of(const OneFrame& frame, const ReduceArguments& arguments,
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
        accuracy::compare(truths.picture_of(record), pair.truth, pair.bound);
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
  report::BugReport report{.message = report::words::text_of(reduction.failure),
                           .device = {},
                           .system = {},
                           .command = {},
                           .changes = {},
                           .factors = reduction.smallest,
                           .frames = reduction.frames,
                           .complete = reduction.complete,
                           .files = {}};
  for (const auto& [factor, from, to, number] :
       reduction::changes(frame.suite, frame.plan.configurations.front(), reduction.smallest)) {
    report.changes.push_back({factor, from, to});
  }
  return report;
}

core::ExitCode reduce(const ReduceArguments& arguments) {
  const Registry registry = make_registry();
  const OneFrame frame = choose_frame(registry, arguments.frame);
  const fs::path out(arguments.frame.out);
  // A README.md without frame.json next to it was not written by `reduce`, so it is kept.
  if (fs::exists(out / "frame.json")) fs::remove(out / "README.md");
  report::remove_frame(out);
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
  const reduction::FirstFrames first = trial.first(start);
  if (!first.first) {
    put("the frame does not fail on {}, so there is nothing to reduce\n", frame.device);
    return core::ExitCode::pass;
  }
  if (!first.repeats()) {
    throw core::NotSupported(report::words::fails_differently(*first.first, first.again));
  }
  say("{}: {}\n", frame.device, report::words::text_of(*first.again));
  const auto on_step = [](const reduction::Step& step) {
    say("{:>4} frames: {} {} → {}\n", step.frame, step.factor, step.from, step.to);
  };
  const reduction::Reduction reduction = reduction::reduce(
      frame.suite, start, *first.again, arguments.frames, std::ref(trial), on_step);
  static_cast<void>(trial(reduction.smallest));
  report::BugReport report = report_of(frame, reduction);
  report.device = trial.device();
  report.system = store.runs().front().system;
  report.files = write_frame(frame, trial, truths, out);
  for (std::string& file :
       write_dump_of(frame, arguments, trial, truths, reduction.failure.reason.limit(), out)) {
    report.files.push_back(std::move(file));
  }
  report.command = command_for(frame, arguments, reduction.failure, trial.last(), report.device);
  core::write_text(out / "README.md", report::markdown(report));
  put_lines(fmt::format("{}\n{} frames drawn; {}{}\n{}\n{}\n", report.message, report.frames,
                        report::text_of(report.changes),
                        report.complete ? "" : "; the search stopped at the limit set by --frames",
                        (out / "README.md").string(), report.command));
  return core::ExitCode::regression;
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
  command
      .add_option(
          "--limit", arguments.limit_s,
          "Treat a frame as hung after this many seconds (default: three times the duration "
          "of the first frame, but at least 20)")
      ->check(CLI::Range(1, 86400));
  command.add_option("--frames", arguments.frames, "Draw at most this many frames")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000));
  command.add_flag("--truth", arguments.truth,
                   "Has no effect, because `reduce` always compares with the reference image; this "
                   "option exists so that a `render` command can be reused");
  add_example(command,
              "triptych reduce volume --device vulkan:lavapipe --set viewport=64 --out small");
}

}  // namespace triptych::app
