#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "app/arguments.hpp"
#include "app/listing.hpp"
#include "app/one_frame.hpp"
#include "app/paths.hpp"
#include "app/registry.hpp"
#include "app/saying.hpp"
#include "app/truth.hpp"
#include "core/json_text.hpp"
#include "measure/run/single_frames.hpp"
#include "measure/system/stopwatch.hpp"
#include "record/factor_list.hpp"
#include "record/hung.hpp"
#include "reduction/reduce.hpp"
#include "report/bug_report.hpp"
#include "report/command.hpp"
#include "report/frame_folder.hpp"

namespace triptych::app {
namespace {

namespace fs = std::filesystem;

struct ReduceArguments {
  FrameArguments frame;
  std::string against;
  int limit_s = 0;  // 0: as the first frame asks for
  int frames = 500;
  bool truth = true;  // render has it; here it is always so
};

measure::RunOptions options_of(const ReduceArguments& arguments) {
  return {.protocol = {},
          .limit = std::chrono::seconds(arguments.limit_s),
          .faults = parse_faults(arguments.frame.faults),
          .worker_command = {own_program(), "worker", "--device"}};
}

// Draws frames of the suite and judges each.
class Trial {
 public:
  // `other`: whose counters are right; empty: nobody's.
  Trial(const Registry& registry, const OneFrame& frame, const measure::RunOptions& options,
        const std::string& other, record::Store& store)
      : store_(store),
        truths_(registry, store),
        frames_(frame.suite, frame.device, store, options, interrupts_) {
    if (other.empty()) return;
    measure::RunOptions healthy = options;
    healthy.faults.clear();
    other_.emplace(frame.suite, other, store, healthy, interrupts_);
  }

  std::optional<reduction::Failure> operator()(const measure::Configuration& configuration) {
    last_ = frames_.draw(configuration);
    return reduction::failure_of(last_, evidence(configuration));
  }

  [[nodiscard]] const record::Record& last() const { return last_; }
  [[nodiscard]] record::Device device() const { return frames_.device(); }
  [[nodiscard]] Truths& truths() { return truths_; }

 private:
  reduction::Evidence evidence(const measure::Configuration& configuration) {
    reduction::Evidence evidence{
        .truth = [this](const record::Record& record) { return truths_.of(record); },
        .picture = [this](const record::Record& record) { return store_.picture(record.image); },
        .open_counts =
            [this](const record::Record& record) { return truths_.open_counts_of(record); }};
    if (other_) {
      evidence.other = [this, &configuration](const record::Record&) {
        return other_->draw(configuration);
      };
    }
    return evidence;
  }

  measure::InterruptGuard interrupts_;
  record::Store& store_;
  Truths truths_;
  measure::SingleFrames frames_;
  std::optional<measure::SingleFrames> other_;
  record::Record last_;
};

// Other counters are wrong only against the other device's, which `render` does not draw on.
std::string command_for(const OneFrame& frame, const ReduceArguments& arguments,
                        const reduction::Failure& failure, const record::Record& record,
                        const record::Device& device) {
  const bool picture = failure.kind != reduction::other_counters;
  report::Command command{.command = picture ? "render" : "reduce",
                          .object = std::string(frame.suite.name()),
                          .device = frame.device,
                          .factors = record::parse_factor_list(record.configuration),
                          .injected = arguments.frame.faults,
                          .limit = record::limit_in(failure.message),
                          .more = {"--truth", "--out", "again"},
                          .environment = device.environment};
  if (!picture) command.more.insert(command.more.begin(), {"--against", arguments.against});
  return report::text_of(command);
}

// What is right, what was drawn where anything was, and what another program needs to draw it.
std::vector<std::string> write_frame(const OneFrame& frame, Trial& trial, record::Store& store,
                                     const fs::path& out) {
  const record::Record& record = trial.last();
  std::vector<std::string> files{"frame.json", "truth.png"};
  const core::Json json =
      report::frame_json(frame.suite.describe(record.factors), record, trial.device());
  write_text(out / "frame.json", core::json_text(json, 2) + "\n");
  const judge::TruthPair& pair = trial.truths().of(record);
  if (record.image.empty()) {
    report::write_picture(out, "truth", pair.truth);
    return files;
  }
  const core::Image image = store.picture(record.image);
  report::write_picture(out, "image", image);
  static_cast<void>(report::write_difference(out, image, pair));
  files.insert(files.end(), {"image.png", "difference.png"});
  return files;
}

report::BugReport report_of(const OneFrame& frame, const reduction::Reduction& reduction) {
  report::BugReport report{.message = reduction.failure.message,
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

// A hang costs its limit with every frame, so it is short. But a driver may take longer to end, and
// what crashed would be called a hang: the first frame has as much time as in a run.
std::chrono::seconds limit_of(const OneFrame& frame, measure::RunOptions options,
                              record::Store& store) {
  constexpr std::chrono::seconds least{20};
  constexpr int times_as_long = 3;
  options.limit = record::standard_limit;
  measure::InterruptGuard interrupts;
  measure::SingleFrames frames(frame.suite, frame.device, store, options, interrupts);
  const measure::Stopwatch taken;
  const record::Record first = frames.draw(frame.plan.configurations.front());
  if (first.outcome == record::Outcome::hung) return least;
  return std::max(least, std::chrono::ceil<std::chrono::seconds>(times_as_long * taken.elapsed()));
}

// The first frame, drawn twice: what fails once of two times cannot be made smaller.
std::optional<reduction::Failure> first_failure(const measure::Configuration& start, Trial& trial) {
  std::optional<reduction::Failure> first = trial(start);
  require_drawable(trial.last());
  if (!first) return first;
  std::optional<reduction::Failure> again = trial(start);
  if (again && again->kind == first->kind) return again;
  throw core::NotSupported(fmt::format(
      "it fails differently when drawn again, and no smaller frame would tell: {}; then {}",
      first->message, again ? again->message : "it is right"));
}

core::ExitCode reduce(const ReduceArguments& arguments) {
  const Registry registry = make_registry();
  const OneFrame frame = choose_frame(registry, arguments.frame);
  const fs::path out(arguments.frame.out);
  const ScratchFile file(out / ".reduce.sqlite");
  record::Store store(file.path(), record::Store::Mode::append);
  const std::string other = arguments.against.empty()
                                ? std::string()
                                : choose_device(registry, "--against", arguments.against);
  measure::RunOptions options = options_of(arguments);
  if (arguments.limit_s == 0) options.limit = limit_of(frame, options, store);
  Trial trial(registry, frame, options, other, store);
  const measure::Configuration& start = frame.plan.configurations.front();
  const std::optional<reduction::Failure> first = first_failure(start, trial);
  if (!first) {
    fmt::print("{} does not fail: there is nothing to make smaller\n", frame.device);
    return core::ExitCode::pass;
  }
  say("{}: {}\n", frame.device, first->message);
  const auto on_step = [](const reduction::Step& step) {
    say("{:>4} frames: {} {} → {}\n", step.frame, step.factor, step.from, step.to);
  };
  const reduction::Reduction reduction =
      reduction::reduce(frame.suite, start, *first, arguments.frames, std::ref(trial), on_step);
  static_cast<void>(trial(reduction.smallest));
  report::BugReport report = report_of(frame, reduction);
  report.device = trial.device();
  report.system = store.runs().front().system;
  report.files = write_frame(frame, trial, store, out);
  report.command = command_for(frame, arguments, reduction.failure, trial.last(), report.device);
  write_text(out / "README.md", report::markdown(report));
  fmt::print("{}\n{} frames drawn; {}{}\n{}\n{}\n", report.message, report.frames,
             report::text_of(report.changes),
             report.complete ? "" : "; the search ended at its limit of frames",
             (out / "README.md").string(), report.command);
  return core::ExitCode::regression;
}

}  // namespace

void add_reduce_command(Commands& commands) {
  auto arguments = std::make_shared<ReduceArguments>();
  arguments->frame.out = "reduced";
  CLI::App* command = commands.add(
      "reduce", "Make a frame that fails as small as it can be, as a folder for a bug report",
      [arguments] { return reduce(*arguments); });
  arguments->frame.add_to(*command);
  command->add_option("--out", arguments->frame.out, "Folder to write into")->capture_default_str();
  command->add_option("--against", arguments->against,
                      "A device whose counters are right: others are a failure too");
  command
      ->add_option("--limit", arguments->limit_s,
                   "Seconds after which a frame counts as hung (default: 20, or three times what "
                   "the first takes)")
      ->check(CLI::Range(1, 86400));
  command->add_option("--frames", arguments->frames, "Draw at most so many")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000));
  command->add_flag("--truth", arguments->truth, "As of render, whose arguments it takes: always");
}

}  // namespace triptych::app
