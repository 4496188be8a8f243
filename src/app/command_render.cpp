#include <fmt/format.h>

#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/arguments.hpp"
#include "app/error_search.hpp"
#include "app/one_frame.hpp"
#include "app/one_pixel.hpp"
#include "app/progress_printer.hpp"
#include "app/terminal.hpp"
#include "core/output_files.hpp"
#include "core/temporary_folder.hpp"
#include "measure/contract/dump.hpp"
#include "measure/contract/standalone.hpp"
#include "measure/request/error_answer.hpp"
#include "measure/request/fastest.hpp"
#include "measure/run/in_process.hpp"
#include "measure/run/runner.hpp"
#include "measure/worker/own_program.hpp"
#include "report/exports/frame_folder.hpp"
#include "report/screen/error_table.hpp"
#include "report/words/finding.hpp"
#include "report/words/requested_error.hpp"

namespace triptych::app {
namespace {

namespace fs = std::filesystem;

struct RenderArguments {
  FrameArguments frame;
  std::optional<std::string> error;  // as typed by the user
  int limit_s = default_limit_s;
  bool untimed = false;
  bool truth = false;
  bool describe = false;
  bool in_process = false;
  std::string dump;   // the folder for --dump; empty if nothing is dumped
  std::string pixel;  // "X,Y"; empty: none
};

// Writes the reference image and the difference image next to the device's image, and prints
// whether the device's image is correct.
core::ExitCode compare_with_reference(const core::Image& image, const judge::TruthPair& pair,
                                      const fs::path& out) {
  const report::ReferenceComparison comparison = report::write_difference(out, image, pair);
  if (comparison.has_difference) {
    print_out(
        "{}: black means no error, white an error equal to the pixel's bound, azure to cyan a "
        "larger error (logarithmic scale)\n",
        (out / "difference.png").string());
  }
  print_lines(report::words::text_of(comparison.what) + "\n");
  return comparison.right() ? core::ExitCode::pass : core::ExitCode::regression;
}

struct Drawing {
  const RenderArguments& arguments;
  std::vector<std::string> devices;
  measure::SuiteWithTruth& suite;
  record::Store& store;
};

struct Drawn {
  std::string run;
  record::Record record;
};

// Returns the default protocol, which is that of the paper (docs/paper.md), but without its
// wall-clock loop, because frame.json contains only the times of single frames.
measure::Protocol render_protocol(const RenderArguments& arguments) {
  measure::Protocol protocol;
  protocol.least_loop_ns = 0;
  protocol.most_loop_frames = 1;
  protocol.timed = !arguments.untimed;
  protocol.statistics = protocol.timed;
  return protocol;
}

std::string measure_in(const Drawing& drawing, const measure::Plan& plan, record::Store& store,
                       const measure::Protocol& protocol) {
  // A single configuration needs no bar, but loading its data may take long.
  const bool several = plan.configurations.size() > 1;
  ProgressPrinter printer;
  const measure::RunResult result =
      measure::run_plan(plan, drawing.devices, drawing.suite, store,
                        {.protocol = protocol,
                         .limit = std::chrono::seconds(drawing.arguments.limit_s),
                         .faults = measure::parse_faults(drawing.arguments.frame.faults),
                         .worker_command = measure::worker_command()},
                        [&](const measure::Progress& progress) {
                          if (several) return printer.print(progress);
                          if (progress.loading) show_loading(*progress.loading);
                        });
  if (several) printer.end();
  return result.run;
}

Drawn draw_one(const Drawing& drawing, const measure::Plan& plan) {
  const std::string run =
      measure_in(drawing, plan, drawing.store, render_protocol(drawing.arguments));
  return {run, drawing.store.records(run).at(0)};
}

// Finds the fastest technique by short trials, and draws with it. If the device cannot draw with
// any technique, returns the result for the first technique.
Drawn draw_fastest(const Drawing& drawing, const measure::Plan& plan) {
  const auto [records, answers] =
      measure::find_fastest(plan, drawing.suite, [&](const measure::Plan& tried) {
        return drawing.store.records(
            measure_in(drawing, tried, drawing.store, measure::brief_protocol));
      });
  if (answers.empty() || answers.front().candidates.empty()) {
    return {records.at(0).run, records.at(0)};
  }
  const record::Record& fastest = *answers.front().candidates.front().record;
  print_lines(describe(answers.front(), plan.automatic) + "\n");
  return {fastest.run, fastest};
}

// Draws with the fastest settings that meet the requested error. If the plan contains several
// techniques (technique=auto), they compete with each other. If the device could not draw anything,
// the returned record contains the reason.
Drawn draw_within_error(const Drawing& drawing, const measure::Plan& plan,
                        measure::Truths& truths) {
  const measure::ErrorGoal goal =
      measure::error_goal(*drawing.arguments.error,
                          names_of(PlanChoice{.set = drawing.arguments.frame.set}.overrides()));
  const measure::ErrorRequest request = search_settings(
      plan, drawing.suite, goal, truths, [&](const measure::Plan& trials, record::Store& store) {
        return measure_in(drawing, trials, store, {.statistics = false, .timed = false});
      });
  if (!request.unreachable.empty()) {
    throw core::NotSupported(report::words::text_of(request.unreachable.front(), goal.request));
  }
  const std::string run =
      measure_in(drawing, request.plan, drawing.store, render_protocol(drawing.arguments));
  const std::vector<record::Record> records = drawing.store.records(run);
  const auto answers = measure::answer_error(records, drawing.suite, goal, truths);
  if (answers.empty()) return {run, records.at(0)};
  // The first answer is the fastest.
  if (answers.front().record == nullptr) {
    throw core::NotSupported(report::words::text_of_missed(answers.front(), goal.request));
  }
  print_lines(report::error_tables(answers, goal.request));
  return {run, *answers.front().record};
}

// Prints a description of the data and draws nothing.
core::ExitCode describe_data(const Registry& registry, const FrameArguments& arguments) {
  const auto [suite, plan] = choose_data(registry, arguments);
  for (const std::string& line : suite.describe_data(plan.configurations.front())) {
    print_lines(line + "\n");
  }
  return core::ExitCode::pass;
}

// Sets environment variables for the backends. They make the backends give names to objects and
// render passes, which debugging tools display. With --dump, they also make the backends write the
// driver's input to the folder `dump`.
void prepare_process(const RenderArguments& arguments) {
  ::setenv("TRIPTYCH_LABELS", "1", 1);
  if (arguments.dump.empty()) return;
  core::require_writable(arguments.dump);
  fs::remove(fs::path(arguments.dump) / "what-was-given.txt");
  fs::remove(fs::path(arguments.dump) / "frame.c");
  ::setenv("TRIPTYCH_DUMP", fs::absolute(arguments.dump).c_str(), 1);
}

// Prints the size of the image, the device and its driver, and the time of a frame if frames were
// timed.
void print_drawn(const record::Record& record, const record::Device& device,
                 const core::Image& image) {
  std::string time;
  if (const auto summary = record::summarise(record.time_ns())) {
    time = fmt::format(" in {:.3f} ms (median of {} frames, {} clock)", summary->median / 1e6,
                       record.time_ns().size(), record.clock());
  }
  print_out("drew {}x{} with {} ({} {}){}\n", image.width, image.height, device.id, device.driver,
            device.driver_version, time);
}

core::ExitCode write_results(const RenderArguments& arguments, measure::SuiteWithTruth& suite,
                             const record::Record& record, const record::Device& device,
                             const core::Image& image,
                             const std::function<judge::TruthPair(const record::Record&)>& truth) {
  const fs::path out(arguments.frame.out);
  const core::Json frame = report::frame_json(suite.describe(record.factors), record, device);
  for (const std::string& file : report::replace_frame(out, image, frame)) print_out("{}\n", file);
  print_drawn(record, device, image);
  if (!arguments.truth) return core::ExitCode::pass;
  return compare_with_reference(image, truth(record), out);
}

core::ExitCode render_in_process(const RenderArguments& arguments) {
  if (arguments.error) {
    throw core::InputError(
        "--error cannot be combined with --in-process, because --error draws several "
        "configurations");
  }
  prepare_process(arguments);
  const Registry registry = make_registry();
  const auto [suite, plan, device] = choose_frame(registry, arguments.frame);
  if (!plan.automatic.empty()) {
    throw core::InputError(
        "technique=auto cannot be combined with --in-process, --dump or --pixel, because it draws "
        "several configurations; name a technique");
  }
  const fs::path out(arguments.frame.out);
  if (!arguments.dump.empty()) measure::write_compile_script(arguments.dump);
  const auto faults = measure::parse_faults(arguments.frame.faults);
  std::optional<measure::PixelPlace> pixel;
  if (!arguments.pixel.empty()) pixel = parse_pixel(arguments.pixel);
  const measure::FrameInProcess drawn =
      measure::draw_in_process(registry.backend(device.substr(0, device.find(':'))), device, suite,
                               plan, faults, (fs::absolute(out) / "capture").string(), pixel);
  const core::TemporaryFolder folder;
  record::Store store(folder.path() / "render.sqlite", record::Store::Mode::append);
  measure::Truths truths(registry.find_suite(), store);
  core::ExitCode code =
      write_results(arguments, suite, drawn.record, drawn.device, drawn.image,
                    [&](const record::Record& record) { return truths.of(record); });
  if (!arguments.dump.empty() && fs::exists(fs::path(arguments.dump) / "frame.c")) {
    const judge::TruthPair& pair = truths.of(drawn.record);
    measure::append_expected(arguments.dump, pair.truth, pair.bound);
  }
  if (drawn.not_drawn > 0) {
    print_out("{} of {} pixels were not drawn; they still have the values from before the frame\n",
              drawn.not_drawn, drawn.image.pixel_count());
    code = core::ExitCode::regression;
  }
  if (!drawn.traced) return code;
  const core::ExitCode shown = print_pixel(suite, drawn, truths.of(drawn.record), out);
  return code == core::ExitCode::pass ? shown : code;
}

// Throws InputError if --untimed is combined with an option that selects the fastest frame.
void require_times_if_compared(const RenderArguments& arguments, const measure::Plan& plan) {
  if (!arguments.untimed || (!arguments.error && plan.automatic.empty())) return;
  throw core::InputError(
      "--error and technique=auto select the fastest frame, which needs frame times; remove "
      "--untimed");
}

core::ExitCode render(const RenderArguments& arguments) {
  if (arguments.describe) return describe_data(make_registry(), arguments.frame);
  if (arguments.frame.device.empty()) make_registry().refuse_missing_device();
  if (arguments.frame.out.empty()) throw core::InputError("--out is required");
  if (arguments.in_process || !arguments.dump.empty() || !arguments.pixel.empty()) {
    return render_in_process(arguments);
  }
  const Registry registry = make_registry();
  const auto [suite, plan, device] = choose_frame(registry, arguments.frame);
  require_times_if_compared(arguments, plan);
  const core::TemporaryFolder folder;
  record::Store store(folder.path() / "render.sqlite", record::Store::Mode::append);
  measure::Truths truths(registry.find_suite(), store);
  const Drawing drawing{arguments, {device}, suite, store};
  const auto [run, record] = arguments.error           ? draw_within_error(drawing, plan, truths)
                             : !plan.automatic.empty() ? draw_fastest(drawing, plan)
                                                       : draw_one(drawing, plan);
  // If there is an image, print_drawn() prints the driver later. A frame that was skipped has not
  // reached the driver. If the device could not be opened, there is no description to print.
  const auto devices = store.devices(run);
  const bool reached_the_driver = record.outcome != record::Outcome::skipped;
  if (record.image.empty() && reached_the_driver && !devices.empty()) {
    print_device(devices.front().device);
  }
  record::require_measured(record);
  if (record.image.empty()) throw core::InputError(record.technique + " does not produce an image");
  const core::Image image = store.decoded_image(record.image);
  return write_results(arguments, suite, record, devices.at(0).device, image,
                       [&](const record::Record& of) { return truths.of(of); });
}

}  // namespace

void add_render_command(Commands& commands) {
  auto [command, arguments] = commands.add(
      "render", "Draw one configuration, and write image.exr, image.png and frame.json", render,
      {.frame = {.allow_auto = true}});
  arguments.frame.add_to(command);
  command.add_option("--out", arguments.frame.out, "Write the files to this folder");
  command.add_option(
      "--error", arguments.error,
      "E or E:METRIC, where METRIC is rms (default), covered, p99.9 or max (only for volumes): "
      "search for fast levels of the factors step, quadrature, ert, adapt and skip for which the "
      "error relative to the scene's limit image (the exact ray integral) is at most E; factors "
      "named by --set keep their levels");
  add_limit_option(command, arguments.limit_s, "the frame");
  command.add_flag("--untimed", arguments.untimed,
                   "Draw only one frame for the image and one for the counters, and omit frame "
                   "times and driver statistics; this takes a fraction of the time");
  command.add_flag("--in-process", arguments.in_process,
                   "Draw only one frame, in this process, for debuggers and capture tools "
                   "(RenderDoc, apitrace, gfxreconstruct); objects and passes have debug names");
  command.add_option("--dump", arguments.dump,
                     "Write everything that the driver receives (device code, options, parameters "
                     "and buffers) to this folder; implies --in-process");
  command.add_option("--pixel", arguments.pixel,
                     "X,Y: print the device's results for this pixel, sample by sample (volumes) "
                     "or sphere by sphere (particles), and mark the first difference from the "
                     "reference (exit code 1); draws additional frames; implies --in-process");
  command.add_flag("--truth", arguments.truth,
                   "Compare with the reference image: write truth.exr, truth.png and "
                   "difference.png, and exit with code 1 if the image is wrong");
  command.add_flag(
      "--describe", arguments.describe,
      "Do not draw; print a summary of the data instead (format, size, spacing, orientation, "
      "elements, range, and a small text preview); needs neither --device nor --out");
  add_example(command,
              "triptych render volume --device vulkan:lavapipe --set viewport=256 --out frame");
}

}  // namespace triptych::app
