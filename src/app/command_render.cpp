#include <fmt/format.h>

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/arguments.hpp"
#include "app/loading.hpp"
#include "app/one_frame.hpp"
#include "app/paths.hpp"
#include "app/registry.hpp"
#include "app/truth.hpp"
#include "core/json.hpp"
#include "core/json_text.hpp"
#include "measure/request/error_request.hpp"
#include "measure/request/fastest.hpp"
#include "report/frame_folder.hpp"

namespace triptych::app {
namespace {

namespace fs = std::filesystem;

struct RenderArguments {
  FrameArguments frame;
  std::optional<std::string> error;  // as it was typed
  int limit_s = standard_limit_s;
  bool truth = false;
};

// Writes the truth and the difference beside the picture, and says whether it is right.
core::ExitCode hold_against_truth(const core::Image& image, const judge::TruthPair& pair,
                                  const fs::path& out) {
  const report::HeldAgainstTruth held = report::write_difference(out, image, pair);
  if (held.white > 0) {
    fmt::print("{}: white is an error of {:.3g}\n", (out / "difference.png").string(), held.white);
  }
  fmt::print("{}\n", held.message);
  return held.right ? core::ExitCode::pass : core::ExitCode::regression;
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

std::string measure_in(const Drawing& drawing, const measure::Plan& plan,
                       const measure::Protocol& protocol = {}) {
  const measure::RunResult result =
      measure::run_plan(plan, drawing.devices, drawing.suite, drawing.store,
                        {.protocol = protocol,
                         .limit = std::chrono::seconds(drawing.arguments.limit_s),
                         .faults = parse_faults(drawing.arguments.frame.faults),
                         .worker_command = {own_program(), "worker", "--device"}},
                        [](const measure::Progress& progress) {
                          if (progress.loading) show_loading(*progress.loading);
                        });
  return result.run;
}

Drawn draw_one(const Drawing& drawing, const measure::Plan& plan) {
  const std::string run = measure_in(drawing, plan);
  return {run, drawing.store.records(run).at(0)};
}

// What may yet turn out to be the fastest: what disturbed a trial may double a time.
std::vector<measure::Configuration> still_in_question(const measure::FastestAnswer& answer,
                                                      const measure::Plan& plan) {
  std::set<std::string> techniques;
  for (const measure::Contestant& each : answer.contestants) {
    if (each.amount <= 2 * answer.contestants.front().amount) {
      techniques.insert(each.record->technique);
    }
  }
  std::vector<measure::Configuration> left = plan.configurations;
  std::erase_if(left, [&](const auto& each) { return !techniques.contains(each.at("technique")); });
  return left;
}

// The fastest by a short trial of all, and one more of the fast ones; where none can be drawn, what
// the first one says.
Drawn draw_the_fastest(const Drawing& drawing, measure::Plan plan) {
  if (drawing.arguments.error) {
    throw core::InputError("--error and auto choose by two rules: name the technique");
  }
  const auto trial = [&] {
    return drawing.store.records(measure_in(drawing, plan, measure::brief_protocol));
  };
  std::vector<record::Record> records = trial();
  const auto first = measure::answer_fastest(records, drawing.suite, plan.automatic);
  if (first.empty() || first.front().contestants.empty()) return {records.at(0).run, records.at(0)};
  plan.configurations = still_in_question(first.front(), plan);
  if (plan.configurations.size() > 1) {
    for (record::Record& again : trial()) records.push_back(std::move(again));
  }
  const auto answers = measure::answer_fastest(records, drawing.suite, plan.automatic);
  const record::Record& fastest = *answers.front().contestants.front().record;
  fmt::print("{}\n", describe(answers.front(), plan.automatic));
  return {fastest.run, fastest};
}

// The fastest that keeps the requested error; of a device that could draw nothing, why.
Drawn draw_within_error(const Drawing& drawing, const measure::Plan& plan,
                        const measure::RequestPictures& pictures) {
  const auto wanted = accuracy::parse_requested_error(*drawing.arguments.error);
  const measure::ErrorRequest request =
      measure::request_error(plan, drawing.suite, wanted, pictures, [](const std::string&) {});
  if (!request.out_of_reach.empty()) throw core::NotSupported(request.out_of_reach.front());
  const std::string run = measure_in(drawing, request.plan);
  const std::vector<record::Record> records = drawing.store.records(run);
  const auto answers = measure::answer_error(records, drawing.suite, wanted, pictures);
  if (answers.empty()) return {run, records.at(0)};
  if (answers.front().record == nullptr) {
    throw core::NotSupported(describe(answers.front(), wanted));
  }
  fmt::print("{}\n", describe(answers.front(), wanted));
  return {run, *answers.front().record};
}

core::ExitCode render(const RenderArguments& arguments) {
  const Registry registry = make_registry();
  const auto [suite, plan, device] = choose_frame(registry, arguments.frame);
  const fs::path out(arguments.frame.out);
  const ScratchFile file(out / ".render.sqlite");
  record::Store store(file.path(), record::Store::Mode::append);
  Truths truths(registry, store);
  const Drawing drawing{arguments, {device}, suite, store};
  const auto [run, record] = !plan.automatic.empty() ? draw_the_fastest(drawing, plan)
                             : arguments.error
                                 ? draw_within_error(drawing, plan, pictures_of(truths))
                                 : draw_one(drawing, plan);
  require_drawable(record);
  if (record.outcome != record::Outcome::measured) throw core::InputError(record.reason);
  if (record.image.empty()) throw core::InputError(record.technique + " draws no picture");
  const core::Image image = store.picture(record.image);
  report::write_picture(out, "image", image);
  const core::Json frame =
      report::frame_json(suite.describe(record.factors), record, store.devices(run).at(0).device);
  write_text(out / "frame.json", core::json_text(frame, 2) + "\n");
  fmt::print("{}\n", (out / "image.exr").string());
  if (!arguments.truth) return core::ExitCode::pass;
  return hold_against_truth(image, truths.of(record), out);
}

}  // namespace

void add_render_command(Commands& commands) {
  auto arguments = std::make_shared<RenderArguments>();
  arguments->frame.chooses = true;
  CLI::App* command =
      commands.add("render", "Draw one configuration: image.exr, image.png, frame.json",
                   [arguments] { return render(*arguments); });
  arguments->frame.add_to(*command);
  command->add_option("--out", arguments->frame.out, "Folder to write into")->required();
  command->add_option("--error", arguments->error,
                      "E or E:METRIC, with rms (the default), covered, p99.9 or max: the error "
                      "against the scene's limit. Chooses the fastest step, quadrature, ert, adapt "
                      "and skip that keep it");
  add_limit_option(*command, arguments->limit_s, "the frame");
  command->add_flag("--truth", arguments->truth,
                    "Hold it against the reference: writes truth.exr, truth.png and "
                    "difference.png, ends with 1 where it is wrong");
}

}  // namespace triptych::app
