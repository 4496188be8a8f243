#include "measure/worker/worker.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/image_io.hpp"
#include "measure/contract/equivalents.hpp"
#include "measure/protocol/clock.hpp"
#include "measure/protocol/frame_proof.hpp"
#include "measure/protocol/injected_fault.hpp"
#include "measure/protocol/protocol.hpp"
#include "measure/protocol/statistics_calibration.hpp"
#include "measure/system/compile_only.hpp"
#include "measure/system/crash_trace.hpp"
#include "measure/system/host_arithmetic.hpp"
#include "measure/system/process_memory.hpp"
#include "measure/system/stopwatch.hpp"
#include "measure/worker/job_failure.hpp"
#include "measure/worker/wire.hpp"
#include "technique/catalogue.hpp"

namespace triptych::measure {
namespace {

technique::Work kind_named(std::string_view name) {
  for (const technique::Work kind : {technique::Work::compute, technique::Work::draw}) {
    if (technique::name_of(kind) == name) return kind;
  }
  throw core::InputError(fmt::format("unknown work type '{}'", name));
}

// Returns the protocol of the job, after adjusting the settings that depend on the work and the
// device.
Protocol protocol_for(const Job& job, const Work& work, bool has_statistics) {
  Protocol protocol = job.protocol;
  protocol.statistics = protocol.statistics && has_statistics;
  if (const auto* particles = std::get_if<ParticleWork>(&work.scene)) {
    protocol.camera_jumps = particles->camera_before.has_value();
  }
  return protocol;
}

class Worker {
 public:
  Worker(std::unique_ptr<Device> device, Suite& suite, std::vector<record::ClockTrust> clocks)
      : device_(std::move(device)),
        suite_(suite),
        info_(device_->info()),
        clocks_(std::move(clocks)) {}

  // Returns the device, including the results of this worker's calibrations.
  [[nodiscard]] const record::Device& info() const { return info_; }
  [[nodiscard]] const std::vector<record::ClockTrust>& clocks() const { return clocks_; }

  // Calibrates the clock and the pipeline statistics for each kind of work. Skips the kinds whose
  // clock is already known, because the supervisor then also knows their statistics calibration.
  // `statistics` states whether pipeline statistics may be read.
  void calibrate_for(const std::vector<std::string>& kinds, bool statistics) {
    has_statistics_ = statistics;
    if (!info_.compiles_for.empty()) return;
    for (const std::string& kind : kinds) {
      if (std::ranges::find(clocks_, kind, &record::ClockTrust::work) != clocks_.end()) continue;
      clocks_.push_back(calibrate_clock(*device_, suite_, kind_named(kind)));
      if (auto fault = clock_fault(clocks_.back())) info_.faults.push_back(std::move(*fault));
      if (!has_statistics_) continue;
      const std::size_t known = info_.faults.size();
      info_.statistics_calibration.merge(
          calibrate_statistics(*device_, kind_named(kind), &info_.faults));
      has_statistics_ = info_.faults.size() == known;
    }
    changed_arithmetic_ = restore_arithmetic();
  }

  [[nodiscard]] Answer answer(const Job& job) {
    const Stopwatch whole;
    Answer answer;
    answer.record.factors = job.configuration;
    outcome_of([&] { run_job(job, answer); }, data_,
               [&](record::Outcome outcome, record::Reason reason) {
                 set_failure(answer, outcome, std::move(reason));
               });
    report_changed_arithmetic([&](record::Reason reason) {
      set_failure(answer, record::Outcome::failed, std::move(reason));
    });
    answer.record.peak_memory_bytes = peak_memory_bytes();
    if (job.report_resident) answer.resident_bytes = resident_memory_bytes();
    answer.worker_ns = whole.ns();
    answer.record.overhead_ns =
        answer.worker_ns - answer.record.prepare_ns - measuring_ns_ + answer.record.overhead_ns;
    return answer;
  }

  [[nodiscard]] Batch hold(const Hold& hold) {
    return batch([&](Batch&) {
      prepared_.reset();
      require_execution();
      Configuration configuration = hold.configuration;
      prepared_ = device_->prepare(work_or_skip(configuration, hold.faults));
      proof_.emplace(*prepared_);
    });
  }

  [[nodiscard]] Batch draw(const Frames& frames) {
    return batch([&](Batch& batch) {
      if (!prepared_)
        throw core::InputError("frames were requested, but no configuration is prepared");
      for (int i = 0; i < frames.count; ++i) {
        const Frame frame = proof_->draw(Purpose::timing);
        proof_->check(fmt::format("frame {} of {}", i + 1, frames.count));
        batch.wall_ns.push_back(frame.wall_ns);
        if (frame.device_ns) batch.device_ns.push_back(*frame.device_ns);
      }
      if (batch.device_ns.size() != batch.wall_ns.size()) batch.device_ns.clear();
    });
  }

  [[nodiscard]] Batch release() {
    return batch([this](Batch&) { prepared_.reset(); });
  }

 private:
  template <typename Action>
  Batch batch(const Action& action) {
    Batch batch;
    outcome_of(
        [&] { action(batch); }, data_,
        [&](record::Outcome outcome, record::Reason reason) {
          batch = {.outcome = outcome, .reason = std::move(reason), .wall_ns = {}, .device_ns = {}};
          // Does not free the objects of a lost device, because drivers fail most often while they
          // free such objects.
          if (outcome == record::Outcome::lost) {
            static_cast<void>(prepared_.release());
          } else {
            prepared_.reset();
          }
        });
    return batch;
  }

  // If a driver has changed the floating-point mode of this process, restores the mode. If the
  // rounding mode was wrong, also reports that the current configuration failed, because data
  // generated in that mode would not be bit-identical to the accepted data.
  template <typename OnFailure>
  void report_changed_arithmetic(const OnFailure& on_failure) {
    std::string changed = restore_arithmetic();
    if (changed.empty()) changed = std::exchange(changed_arithmetic_, {});
    if (changed.empty()) return;
    on_failure(record::Reason{
        .cause = record::Cause::error,
        .detail = "the driver changed the floating-point mode of this process: " + changed});
  }

  // Sets the outcome, and removes all results that would suggest that the configuration was
  // measured.
  static void set_failure(Answer& answer, record::Outcome outcome, record::Reason reason) {
    record::Record record;
    record.factors = std::move(answer.record.factors);
    record.prepare_ns = answer.record.prepare_ns;
    record.outcome = outcome;
    record.reason = std::move(reason);
    answer.record = std::move(record);
    answer.exr.clear();
    answer.listings.clear();
  }

  // Creates the Work, which describes everything that the device has to draw for the configuration
  // (technique, scene and options), and resolves the configuration's "auto" levels. Throws
  // NotSupported if the input data is missing or if the device does not support the Work.
  Work supported_work(Configuration& configuration, const std::vector<std::string>& faults) {
    const auto data = configuration.find("data");
    data_ = data == configuration.end() ? "none" : data->second;
    if (std::string reason = suite_.missing_data(configuration); !reason.empty()) {
      throw MissingData(reason, data_);
    }
    Work work = suite_.work(configuration, *device_);
    for (const std::string& fault : faults) inject(fault, work);
    if (const auto reason = device_->unsupported(work)) throw core::NotSupported(*reason);
    return work;
  }

  // Like supported_work(), but throws BadInput for invalid input. The message states the place in
  // the input, such as a line of a file.
  Work work_or_skip(Configuration& configuration, const std::vector<std::string>& faults) {
    try {
      return supported_work(configuration, faults);
    } catch (const core::InputError& error) {
      throw BadInput(error.what());
    }
  }

  void run_job(const Job& job, Answer& answer) {
    measuring_ns_ = 0;
    if (!job.protocol.compiled) require_execution();
    const Stopwatch whole;
    Configuration configuration = job.configuration;
    const Work work = work_or_skip(configuration, job.faults);
    if (job.protocol.compiled) return compile(work, std::move(configuration), answer);
    const bool may_reuse = !job.protocol.measure_every && job.faults.empty();
    std::optional<PlainWork> plain;
    if (may_reuse) plain = suite_.plain(configuration, work);
    if (const auto equivalent = plain ? equivalents_.find(*plain) : std::nullopt) {
      answer.record.outcome = record::Outcome::measured;
      answer.record.same_as = equivalent->key;
      answer.record.reason = {.cause = record::Cause::same_frames, .detail = equivalent->reason};
      answer.record.prepare_ns = whole.ns();
      answer.record.factors = std::move(configuration);
      return;
    }
    if (job.protocol.counted) return count(job, work, std::move(configuration), answer);
    const auto prepared = device_->prepare(work);
    const double prepare_ns = whole.ns();
    answer.record.prepare_ns = prepare_ns;

    if (job.protocol.has_loop() && !meters_) meters_.emplace();
    const Stopwatch measuring;
    Measurement measured = measure(*prepared, protocol_for(job, work, has_statistics_),
                                   technique::technique(work.technique).work, clocks_, job.name,
                                   meters_ ? &*meters_ : nullptr);
    measuring_ns_ = measuring.ns();
    answer.record = std::move(measured.record);
    answer.record.memory = device_->memory();
    answer.record.prepare_ns = prepare_ns;
    answer.record.factors = std::move(configuration);
    describe_work(work, *device_, answer.record);
    for (const std::string& fault : job.faults) inject(fault, answer.record);
    if (plain) {
      equivalents_.add(*plain, configuration_key(suite_, job.configuration), work, measured.image);
    }
    keep_image(work, measured.image, answer);
  }

  void require_execution() const {
    if (!info_.compiles_for.empty()) throw core::NotSupported(std::string(only_compiles));
  }

  void compile(const Work& work, Configuration configuration, Answer& answer) {
    const Stopwatch compiling;
    Compiled compiled = device_->compile(work);
    measuring_ns_ = compiling.ns();
    answer.record.outcome = record::Outcome::measured;
    answer.record.code = std::move(compiled.code);
    answer.record.factors = std::move(configuration);
    answer.listings = std::move(compiled.listings);
  }

  static void keep_image(const Work& work, const core::Image& image, Answer& answer) {
    if (technique::technique(work.technique).draws_image) {
      answer.exr = core::encode_exr(image);
    } else {
      answer.record.image.clear();  // the technique's image has no meaning
    }
  }

  // Makes the driver compile all code that count() uses.
  void compile_ahead(const Protocol& protocol, const Work& work, Answer& answer) {
    const auto prepared = device_->prepare(work);
    static_cast<void>(prepared->frame(Purpose::timing));
    if (protocol.counters) static_cast<void>(prepared->frame(Purpose::counters));
    describe_work(work, *device_, answer.record);
    answer.record.outcome = record::Outcome::measured;
  }

  // Counts instructions under the emulator. No clock is needed.
  void count(const Job& job, const Work& work, Configuration configuration, Answer& answer) {
    if (job.protocol.ahead) return compile_ahead(job.protocol, work, answer);
    if (!counter_) counter_ = InstructionCounter::of_this_process();
    if (!counter_)
      throw core::NotSupported("this worker is not running under the instruction counter");
    record::Counts prepare_cost;
    const Stopwatch measuring;
    const auto prepared = counter_->count(prepare_cost, [&] { return device_->prepare(work); });
    Measurement measured =
        count_instructions(*prepared, protocol_for(job, work, has_statistics_), *counter_);
    measuring_ns_ = measuring.ns();
    answer.record = std::move(measured.record);
    if (job.protocol.keep_image) keep_image(work, measured.image, answer);
    answer.record.memory = device_->memory();
    answer.record.prepare_cost = std::move(prepare_cost);
    answer.record.factors = std::move(configuration);
    describe_work(work, *device_, answer.record);
  }

  std::unique_ptr<Device> device_;
  Suite& suite_;
  record::Device info_;
  std::vector<record::ClockTrust> clocks_;
  std::optional<InstructionCounter> counter_;
  // Created only when a loop needs the meters, because the constructor loads a library.
  std::optional<EnergyMeters> meters_;
  std::unique_ptr<Prepared> prepared_;
  std::optional<FrameProof> proof_;  // for the configuration in `prepared_`
  Equivalents equivalents_;
  bool has_statistics_ = true;  // false if reading pipeline statistics caused a device fault
  // The wrong rounding mode that the driver set while the device was opened and calibrated.
  std::string changed_arithmetic_;
  std::string data_;         // name of the current configuration's data
  double measuring_ns_ = 0;  // time that the latest job spent on measuring
};

// Makes the kernel kill this worker when its supervisor dies. Otherwise, the worker could continue
// to use the device, for example if it hangs in a driver call.
void die_with_parent() {
  const pid_t parent = ::getppid();
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) std::raise(SIGKILL);
}

// Sets close-on-exec, so that processes that a driver starts do not keep the pipes to the
// supervisor open after this process has ended.
void set_close_on_exec(int fd) {
  if (const int flags = ::fcntl(fd, F_GETFD); flags >= 0) ::fcntl(fd, F_SETFD, flags | FD_CLOEXEC);
}

record::Outcome serve_one(Worker& worker, const Message& message, int answer_fd) {
  if (const auto job = as_job(message)) {
    Answer answer = worker.answer(*job);
    const record::Outcome outcome = answer.record.outcome;
    send(answer_fd, to_message(std::move(answer)));
    return outcome;
  }
  Batch batch;
  if (const auto hold = as_hold(message)) {
    batch = worker.hold(*hold);
  } else if (const auto frames = as_frames(message)) {
    batch = worker.draw(*frames);
  } else if (as_release(message)) {
    batch = worker.release();
  } else {
    throw core::InputError(
        fmt::format("unknown request to a worker: '{}'", message.json.value("type", "")));
  }
  send(answer_fd, to_message(batch));
  return batch.outcome;
}

int serve(const Backend& backend, std::string_view device_id, const FindSuite& find_suite,
          int request_fd, int answer_fd) {
  const auto first = receive(request_fd);
  if (!first) return 0;
  const auto start = as_start(*first);
  if (!start) throw core::InputError("a worker's first message must be 'start'");
  Suite& suite = find_suite(start->suite);
  suite.set_on_loading(
      throttled([answer_fd](const Loading& loading) { send(answer_fd, to_message(loading)); }));
  Worker worker(backend.open(device_id), suite, start->clocks);
  worker.calibrate_for(start->kinds, start->statistics);
  send(answer_fd, to_message(Hello{.device = worker.info(), .clocks = worker.clocks()}));

  while (const auto message = receive(request_fd)) {
    // Exits without freeing the objects of a lost device, because drivers fail most often while
    // they free such objects.
    if (serve_one(worker, *message, answer_fd) == record::Outcome::lost) ::_exit(0);
  }
  return 0;
}

}  // namespace

void describe_work(const Work& work, const Device& device, record::Record& record) {
  if (const auto* volume = std::get_if<VolumeWork>(&work.scene)) {
    record.data_hash = volume->scene.grid->hash;
    record.precision["filter_weight_error"] = device.filter_weight_error(
        {.voxel = volume->scene.grid->format, .sampler = volume->options.sampler});
  } else if (const auto* particles = std::get_if<ParticleWork>(&work.scene)) {
    record.data_hash = particles->scene.particles->hash;
    if (const auto rasterizer = device.rasterizer()) {
      record.precision["sub_pixel_bits"] = rasterizer->sub_pixel_bits;
      const bool points = technique::technique(work.technique).vertices == technique::Vertices::one;
      if (points) {
        record.precision["point_margin"] = rasterizer->point_margin;
        record.precision["largest_point"] = rasterizer->largest_point;
      }
    }
  }
}

int serve_worker(const Backend& backend, std::string_view device_id, const FindSuite& find_suite,
                 int request_fd, int answer_fd) {
  die_with_parent();
  install_stack_trace_handlers();
  set_close_on_exec(request_fd);
  set_close_on_exec(answer_fd);
  Refused refused;
  try {
    return serve(backend, device_id, find_suite, request_fd, answer_fd);
  } catch (const core::NotSupported& error) {
    refused.reason = {.cause = record::Cause::not_supported, .detail = error.what()};
  } catch (const core::ApiError& error) {
    refused.reason = api_reason(record::Cause::api_error, error);
  } catch (const std::exception& error) {
    refused.reason = {.cause = record::Cause::error, .detail = error.what()};
  }
  try {
    send(answer_fd, to_message(refused));
  } catch (const core::Error&) {
    // The supervisor is gone, so the error cannot be reported.
  }
  return static_cast<int>(core::ExitCode::usage);
}

}  // namespace triptych::measure
