#include "backends/opencl/anchor_frames.hpp"

#include <fmt/format.h>

#include <chrono>
#include <span>

#include "technique/anchors/shape.hpp"
#include "triptych_backend_opencl_embedded.hpp"

namespace triptych::opencl_backend {
namespace {

constexpr const char* options = "-cl-std=CL1.2";

std::size_t bytes_of(std::uint64_t words) {
  return sizeof(std::uint32_t) * words;
}

technique::AnchorFrame shape_of(const std::string& technique, int size) {
  technique::AnchorFrame shape = technique::anchor_frame(technique, size);
  if (technique == "anchor_arithmetic") {  // more chains to a work item
    shape.groups = technique::anchor_shape::arithmetic_groups_opencl;
    shape.result_words = std::uint64_t{shape.groups} * technique::anchor_shape::group;
  }
  return shape;
}

}  // namespace

std::optional<std::string> anchor_defect(const Session& session, const std::string& technique,
                                         const measure::AnchorWork& work) {
  if (auto reason = technique::anchor_size_reason(technique, work.size)) return reason;
  const technique::AnchorFrame shape = shape_of(technique, work.size);
  const std::uint64_t bytes = bytes_of(shape.result_words);
  const std::uint64_t all = bytes + bytes_of(shape.source_words);
  return checked([&]() -> std::optional<std::string> {
    const auto group = session.device.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
    if (group < technique::anchor_shape::group) {
      return fmt::format("work-groups of {}, CL_DEVICE_MAX_WORK_GROUP_SIZE is {}",
                         technique::anchor_shape::group, group);
    }
    const auto most = session.device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
    if (bytes > most) {
      return fmt::format("{} bytes in one buffer, CL_DEVICE_MAX_MEM_ALLOC_SIZE is {}", bytes, most);
    }
    const auto total = session.device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
    if (all > total) {
      return fmt::format("{} bytes are needed, CL_DEVICE_GLOBAL_MEM_SIZE is {}", all, total);
    }
    return std::nullopt;
  });
}

AnchorFrames::AnchorFrames(const Session& session, Programs& programs, const std::string& technique,
                           const measure::AnchorWork& work)
    : session_(session), shape_(shape_of(technique, work.size)) {
  // Nothing before the frozen text: the prelude of the other kernels may change.
  const std::string source(embedded(technique + ".cl"));
  hash_ = Programs::hash(source, options);
  const cl::Program program = programs.get(source, options);
  checked([&] {
    results_ = cl::Buffer(session.context, CL_MEM_READ_WRITE, bytes_of(shape_.result_words));
    input_ = make_input();
    launches_.assign(shape_.launches, launch(program, technique));
  });
}

cl::Buffer AnchorFrames::make_input() const {
  if (shape_.source_words > 0) {
    const std::vector<std::uint32_t> source = technique::anchor_source(shape_.source_words);
    return upload_bytes(session_, std::as_bytes(std::span(source)));
  }
  if (shape_.fetches) {
    const std::vector<float> volume = technique::anchor_volume();
    return upload_bytes(session_, std::as_bytes(std::span(volume)));
  }
  return {};
}

Launch AnchorFrames::launch(const cl::Program& program, const std::string& technique) const {
  const std::size_t group = technique == "anchor_launch" ? 1 : technique::anchor_shape::group;
  Launch made =
      make_launch(program, technique, cl::NDRange(shape_.groups * group), cl::NDRange(group),
                  shape_.parameters.work, shape_.parameters.numbers, results_);
  if (input_() != nullptr) made.kernel.setArg(3, input_);
  return made;
}

measure::Frame AnchorFrames::frame(measure::Purpose purpose) {
  return checked([&] {
    const bool counts = purpose == measure::Purpose::counters;
    if (counts) {
      session_.queue.enqueueFillBuffer(results_, cl_uint{0}, 0, bytes_of(shape_.result_words));
      session_.queue.finish();
    }
    measure::Frame frame;
    const auto begin = std::chrono::steady_clock::now();
    run(session_, launches_, events_);
    const auto end = std::chrono::steady_clock::now();
    frame.wall_ns = std::chrono::duration<double, std::nano>(end - begin).count();
    if (purpose == measure::Purpose::timing && events_.size() == 1) {
      frame.device_ns = device_ns(events_);
    }
    if (counts) {
      std::vector<std::uint32_t> words(shape_.result_words);
      session_.queue.enqueueReadBuffer(results_, CL_TRUE, 0, bytes_of(shape_.result_words),
                                       words.data());
      frame.counts.emplace(technique::anchor_counter, technique::anchor_checksum(words));
    }
    return frame;
  });
}

}  // namespace triptych::opencl_backend
