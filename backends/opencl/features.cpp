#include "backends/opencl/features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include "backends/opencl/launches.hpp"
#include "core/error.hpp"
#include "triptych_backend_opencl_embedded.hpp"

namespace triptych::opencl_backend {
namespace {

using measure::count_right;
using measure::judged_feature;
using measure::ProbedFeature;

// The objects that feature probes use.
struct Bench {
  const Session& session;
  Programs& programs;

  [[nodiscard]] cl::Program program() const {
    return programs.get(std::string(embedded("features.cl")), "-cl-std=CL1.2");
  }
  template <class Info>
  [[nodiscard]] auto limit(Info read) const {
    return checked([&] { return read(session.device); });
  }
};

template <class Value>
cl::Buffer filled(const Bench& bench, const std::vector<Value>& values) {
  const std::size_t bytes = values.size() * sizeof(Value);
  cl::Buffer buffer = make_buffer(bench.session, CL_MEM_READ_WRITE, bytes);
  write_buffer(bench.session, buffer, 0, bytes, values.data());
  return buffer;
}

cl::Buffer result_buffer(const Bench& bench, std::size_t words) {
  return filled(bench, std::vector<cl_uint>(words, 0xFFFFFFFF));
}

template <class Value>
std::vector<Value> read_back(const Bench& bench, const cl::Buffer& buffer, std::size_t count) {
  std::vector<Value> values(count);
  read_buffer(bench.session, buffer, count * sizeof(Value), values.data());
  return values;
}

ProbedFeature probe_groups(const Bench& bench) {
  constexpr std::size_t across = 70'000;
  constexpr std::size_t count = 4 * across;
  const cl::Buffer numbers = result_buffer(bench, count);
  run_checked(bench.session,
              {make_launch(bench.program(), "write_groups", cl::NDRange(across, 2, 2),
                           cl::NDRange(1, 1, 1), numbers)});
  const auto found = read_back<cl_uint>(bench, numbers, count);
  return judged_feature(count_right(found, [](std::size_t i) { return i + 1; }), count,
                        fmt::format("{} x 2 x 2 groups", across));
}

// Runs the same kernel at the beginning of a buffer and at `offset`. If the driver dropped the
// upper bits of an index, the second run would overwrite the beginning.
ProbedFeature probe_offset(const Bench& bench, std::uint64_t offset) {
  constexpr std::size_t count = 65536;
  constexpr std::uint64_t bytes = count * sizeof(cl_uint);
  const std::uint64_t needed = offset + bytes;
  const auto most = bench.limit(
      [](const cl::Device& device) { return device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>(); });
  if (needed > most) {
    throw core::NotSupported(fmt::format(
        "needs a buffer of {} bytes, but CL_DEVICE_MAX_MEM_ALLOC_SIZE is {}", needed, most));
  }
  const cl::Buffer buffer = make_buffer(bench.session, CL_MEM_READ_WRITE, needed);
  const cl::Program program = bench.program();
  std::uint64_t right = 0;
  const auto line = [&](std::uint64_t begin, cl_uint first, cl_uint factor) {
    return make_launch(program, "write_line", cl::NDRange(count), cl::NullRange, buffer,
                       cl_ulong{begin / sizeof(cl_uint)}, first, factor);
  };
  run_checked(bench.session, {line(0, 7, 3), line(offset, 11, 5)});
  const auto count_line = [&](std::uint64_t begin, cl_uint first, cl_uint factor) {
    std::vector<cl_uint> found(count);
    checked([&] {
      bench.session.queue.enqueueReadBuffer(buffer, CL_TRUE, begin, bytes, found.data());
    });
    right +=
        count_right(found, [&](std::size_t i) { return first + factor * static_cast<cl_uint>(i); });
  };
  count_line(0, 7, 3);
  count_line(offset, 11, 5);
  return judged_feature(right, 2 * count, fmt::format("offset of {} bytes", offset));
}

template <class Value>
ProbedFeature probe_small_storage(const Bench& bench, const char* kernel, unsigned factor) {
  constexpr std::size_t count = 100'000;
  std::vector<Value> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<Value>(7 * i);
  const cl::Buffer buffer = filled(bench, values);
  run_checked(bench.session,
              {make_launch(bench.program(), kernel, cl::NDRange(count), cl::NullRange, buffer)});
  const auto found = read_back<Value>(bench, buffer, count);
  return judged_feature(
      count_right(found, [&](std::size_t i) { return static_cast<Value>(7 * i + factor * i); }),
      count, fmt::format("{} {}-bit values", count, 8 * sizeof(Value)));
}

ProbedFeature probe_launch_offset(const Bench& bench) {
  constexpr std::size_t count = 100'000;
  constexpr std::size_t begin = 30'000;
  const cl::Buffer numbers = result_buffer(bench, count);
  const Launch launch = make_launch(bench.program(), "write_numbers", cl::NDRange(count - begin),
                                    cl::NullRange, numbers);
  checked([&] {
    const Queue& queue = bench.session.queue;
    queue.enqueueNDRangeKernel(launch.kernel, cl::NDRange(begin), launch.global, cl::NullRange);
    queue.finish();
  });
  const auto found = read_back<cl_uint>(bench, numbers, count);
  return judged_feature(
      count_right(found, [](std::size_t i) { return i < begin ? 0xFFFFFFFFU : i; }), count,
      fmt::format("offset of {}", begin));
}

// Checks that every command is complete after clFinish, which means that its event has the status
// CL_COMPLETE. If a driver completes events late, an event may still happen to be complete in time,
// so the probe runs several rounds. Each command takes some milliseconds, so that the last command
// is still running when clFinish is called.
ProbedFeature probe_event_status(const Bench& bench) {
  constexpr std::size_t numbers = std::size_t{1} << 22U;
  constexpr std::size_t commands = 4;
  constexpr std::size_t rounds = 16;
  const cl::Buffer buffer = result_buffer(bench, numbers);
  const Launch launch =
      make_launch(bench.program(), "write_numbers", cl::NDRange(numbers), cl::NullRange, buffer);
  std::uint64_t complete = 0;
  for (std::size_t round = 0; round < rounds; ++round) {
    std::vector<cl::Event> events(commands);
    checked([&] {
      for (cl::Event& event : events) {
        bench.session.queue.enqueueNDRangeKernel(launch.kernel, cl::NullRange, launch.global,
                                                 cl::NullRange, nullptr, &event);
      }
      bench.session.queue.finish();
    });
    std::vector<cl_int> statuses;
    for (const cl::Event& event : events) {
      statuses.push_back(
          checked([&] { return event.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>(); }));
    }
    complete += count_right(statuses, [](std::size_t) { return CL_COMPLETE; });
  }
  return judged_feature(complete, commands * rounds,
                        fmt::format("{} command events after clFinish", commands * rounds));
}

// Images

cl::Image2D float_image(const Bench& bench, std::size_t width, std::size_t height,
                        std::vector<float>& texels) {
  if (bench.limit([](const cl::Device& device) {
        return device.getInfo<CL_DEVICE_IMAGE_SUPPORT>();
      }) == CL_FALSE) {
    throw core::NotSupported("CL_DEVICE_IMAGE_SUPPORT is false");
  }
  return checked([&] {
    return cl::Image2D(bench.session.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
                       cl::ImageFormat(CL_R, CL_FLOAT), width, height, 0, texels.data());
  });
}

constexpr std::size_t image_edge = 16;

// Returns the index of the texel that coordinate `at` addresses along one axis. `at` may lie
// outside of the image. Returns `image_edge` for the border.
std::size_t addressed(int at, std::string_view kernel) {
  constexpr int size = static_cast<int>(image_edge);
  if (kernel == "sample_border")
    return at < 0 || at >= size ? image_edge : static_cast<std::size_t>(at);
  const int period = kernel == "sample_mirrored" ? 2 * size : size;
  const int within = (at % period + period) % period;
  return static_cast<std::size_t>(within < size ? within : period - 1 - within);
}

// Reads texels at coordinates inside and outside of an image, and compares them with the texels
// that the addressing mode should select. A read of the border of a single-channel image returns 0.
ProbedFeature probe_addressing(const Bench& bench, const char* kernel) {
  constexpr std::size_t side = 4 * image_edge;
  constexpr std::size_t count = side * side;
  std::vector<float> texels(image_edge * image_edge);
  std::iota(texels.begin(), texels.end(), 2.0F);
  const cl::Image2D image = float_image(bench, image_edge, image_edge, texels);
  const cl::Buffer values = result_buffer(bench, count);
  run_checked(bench.session, {make_launch(bench.program(), kernel, cl::NDRange(count),
                                          cl::NullRange, image, values, cl_int{image_edge})});
  const auto found = read_back<float>(bench, values, count);
  const auto expected = [&](std::size_t i) {
    const auto place = [](std::size_t at) {
      return static_cast<int>(at) - static_cast<int>(image_edge);
    };
    const std::size_t x = addressed(place(i % side), kernel);
    const std::size_t y = addressed(place(i / side), kernel);
    return x == image_edge || y == image_edge ? 0.0F : texels[x + image_edge * y];
  };
  return judged_feature(count_right(found, expected), count,
                        "coordinates from -1 to 3 on both axes");
}

ProbedFeature probe_wide_image(const Bench& bench) {
  const auto width = bench.limit(
      [](const cl::Device& device) { return device.getInfo<CL_DEVICE_IMAGE2D_MAX_WIDTH>(); });
  std::vector<float> texels(2 * width);
  std::iota(texels.begin(), texels.end(), 1.0F);
  const cl::Image2D image = float_image(bench, width, 2, texels);
  const cl::Buffer values = result_buffer(bench, width);
  run_checked(bench.session, {make_launch(bench.program(), "fetch_row", cl::NDRange(width),
                                          cl::NullRange, image, values)});
  const auto found = read_back<float>(bench, values, width);
  return judged_feature(count_right(found, [&](std::size_t i) { return texels[width + i]; }), width,
                        fmt::format("{} x 2 texels", width));
}

}  // namespace

std::vector<measure::FeatureProbe> feature_probes(const Session& session, Programs& programs) {
  constexpr std::uint64_t gibibyte = std::uint64_t{1} << 30U;
  const auto probe = [&](std::string name, auto run) {
    return measure::FeatureProbe{.name = std::move(name),
                                 .run = [bench = Bench{session, programs}, run] {
                                   return checked([&] { return run(bench); });
                                 }};
  };
  return {
      probe("work-groups", probe_groups),
      probe("offset-2-gib", [](const Bench& on) { return probe_offset(on, 2 * gibibyte); }),
      probe("offset-4-gib", [](const Bench& on) { return probe_offset(on, 4 * gibibyte); }),
      probe("8-bit-storage",
            [](const Bench& on) { return probe_small_storage<cl_uchar>(on, "add_bytes", 1); }),
      probe("16-bit-storage",
            [](const Bench& on) { return probe_small_storage<cl_ushort>(on, "add_shorts", 3); }),
      probe("launch-offset", probe_launch_offset),
      probe("event-status", probe_event_status),
      probe("repeat", [](const Bench& on) { return probe_addressing(on, "sample_repeat"); }),
      probe("mirrored-repeat",
            [](const Bench& on) { return probe_addressing(on, "sample_mirrored"); }),
      probe("border", [](const Bench& on) { return probe_addressing(on, "sample_border"); }),
      probe("wide-image", probe_wide_image)};
}

}  // namespace triptych::opencl_backend
