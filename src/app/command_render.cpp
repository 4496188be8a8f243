#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "accuracy/image_fault.hpp"
#include "app/arguments.hpp"
#include "app/listing.hpp"
#include "app/loading.hpp"
#include "app/paths.hpp"
#include "app/registry.hpp"
#include "app/truth.hpp"
#include "core/image_io.hpp"
#include "core/json.hpp"
#include "core/json_text.hpp"
#include "measure/request/error_request.hpp"
#include "record/bad_input.hpp"

namespace triptych::app {
namespace {

namespace fs = std::filesystem;

struct RenderArguments {
  std::string suite;
  std::string device;
  std::vector<std::string> set;
  std::string out;
  std::optional<std::string> error;  // as it was typed
  bool truth = false;
  std::vector<std::string> plants;
};

// The store of the one run that a picture is; gone when the picture is written.
class ScratchFile {
 public:
  explicit ScratchFile(fs::path path) : path_(std::move(path)) { remove(); }
  ~ScratchFile() { remove(); }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  void remove() const {
    std::error_code ignored;
    for (const char* suffix : {"", "-wal", "-shm"}) fs::remove(path_.string() + suffix, ignored);
  }
  fs::path path_;
};

core::Json clock_json(const std::vector<double>& samples) {
  return {{"samples", samples}};
}

// frame.json: enough for another program to draw the same frame.
core::Json frame_json(measure::SuiteWithTruth& suite, const record::Record& record,
                      const record::Device& device) {
  core::Json frame = suite.describe(record.factors);
  frame["schema"] = 1;
  frame["suite"] = record.suite;
  frame["technique"] = record.technique;
  frame["device"] = record.device;
  frame["driver"] = device.driver + " " + device.driver_version;
  frame["factors"] = record.factors;
  frame["counters"] = record.counters;
  frame["statistics"] = record.statistics;
  frame["time_ns"] = {{"device", clock_json(record.device_ns)},
                      {"wall", clock_json(record.wall_ns)}};
  frame["time_ns"]["device"]["trusted"] = record.device_clock_trusted;
  return frame;
}

// Writes the truth and the difference beside the picture, and says whether it is right.
core::ExitCode hold_against_truth(const core::Image& image, const judge::TruthPair& pair,
                                  const fs::path& out) {
  const accuracy::ImageComparison comparison = accuracy::compare(image, pair.truth, pair.bound);
  const std::string wrong = accuracy::image_fault(comparison, image, pair.truth, "the truth");
  core::write_exr(pair.truth, out / "truth.exr");
  core::write_png(pair.truth, out / "truth.png");
  if (!comparison.size_mismatch) {
    const double white = comparison.largest.error > 0 ? comparison.largest.error : 1;
    core::write_png(accuracy::difference_image(image, pair.truth, 1 / white),
                    out / "difference.png");
    fmt::print("{}: white is an error of {:.3g}\n", (out / "difference.png").string(), white);
  }
  fmt::print("{}\n",
             wrong.empty() ? "within the bound of the truth; " + describe(comparison) : wrong);
  return wrong.empty() ? core::ExitCode::pass : core::ExitCode::regression;
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

std::string measure_in(const Drawing& drawing, const measure::Plan& plan) {
  const measure::RunResult result =
      measure::run_plan(plan, drawing.devices, drawing.suite, drawing.store,
                        {.plants = parse_plants(drawing.arguments.plants),
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
  measure::SuiteWithTruth& suite = registry.suite(arguments.suite);
  measure::Plan plan = measure::default_plan(suite, parse_overrides(arguments.set));
  if (plan.configurations.size() != 1) {
    throw core::InputError("render draws one configuration: give each factor one value");
  }
  const fs::path out(arguments.out);
  require_writable(out);
  if (const std::string reason = suite.missing_data(plan.configurations.front()); !reason.empty()) {
    throw core::InputError(reason);
  }
  const std::vector<std::string> devices =
      choose_devices(list_devices(registry), {arguments.device});
  if (devices.size() != 1) {
    throw core::InputError(
        fmt::format("--device {} matches {} devices; name one", arguments.device, devices.size()));
  }
  const ScratchFile file(out / ".render.sqlite");
  record::Store store(file.path(), record::Store::Mode::append);
  Truths truths(registry, store);
  const Drawing drawing{arguments, devices, suite, store};
  const auto [run, record] = !arguments.error
                                 ? draw_one(drawing, plan)
                                 : draw_within_error(drawing, plan, pictures_of(truths));
  const bool cannot = record.outcome == record::Outcome::skipped && !record::has_bad_input(record);
  if (cannot) throw core::NotSupported(record.reason);
  if (record.outcome != record::Outcome::measured) throw core::InputError(record.reason);
  if (record.image.empty()) throw core::InputError(record.technique + " draws no picture");
  const core::Image image = store.picture(record.image);
  core::write_exr(image, out / "image.exr");
  core::write_png(image, out / "image.png");
  write_text(out / "frame.json",
             core::json_text(frame_json(suite, record, store.devices(run).at(0).device), 2) + "\n");
  fmt::print("{}\n", (out / "image.exr").string());
  if (!arguments.truth) return core::ExitCode::pass;
  return hold_against_truth(image, truths.of(record), out);
}

}  // namespace

void add_render_command(Commands& commands) {
  auto arguments = std::make_shared<RenderArguments>();
  CLI::App* command =
      commands.add("render", "Draw one configuration: image.exr, image.png, frame.json",
                   [arguments] { return render(*arguments); });
  command->add_option("SUITE", arguments->suite, "volume or particles")->required();
  command->add_option("--device", arguments->device, "Device id or a glob for one")->required();
  command->add_option("--set", arguments->set,
                      "factor=value (repeatable); a comma in it is spelled %2C");
  command->add_option("--out", arguments->out, "Folder to write into")->required();
  command->add_option("--error", arguments->error,
                      "E or E:METRIC, with rms (the default), covered, p99.9 or max: the error "
                      "against the scene's limit. Chooses the fastest step, quadrature, ert, adapt "
                      "and skip that keep it");
  command->add_flag("--truth", arguments->truth,
                    "Hold it against the reference: writes truth.exr, truth.png and "
                    "difference.png, ends with 1 where it is wrong");
  command->add_option("--plant", arguments->plants, "Inject a fault, as for run (repeatable)");
}

}  // namespace triptych::app
