#pragma once
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "backends/gl/objects.hpp"
#include "record/record.hpp"

namespace triptych::gl_backend {

struct Elapsed {
  double wall_ns = 0;
  std::optional<double> device_ns;
};

// The times at which the device takes the two timestamps of a frame.
enum class Stamps : std::uint8_t {
  in_stream,  // immediately before and after the work, as on GPUs
  // The first timestamp is taken before the work is submitted, and the second after the work has
  // finished. Software renderers run compute work and take timestamps on different threads, so
  // timestamps in the stream measure almost nothing.
  finished
};

// Measures work by the wall clock and by the device's clock.
class Stopwatch {
 public:
  Stopwatch(const Api& gl, Stamps stamps);

  // `submit` makes the GL calls that are timed. The wall clock runs from just before these calls
  // until the device has signalled a fence that follows them. Waiting for the fence does not spin.
  template <class Submit>
  [[nodiscard]] Elapsed time(Submit&& submit) {
    start();
    submit();
    return stop();
  }

 private:
  void start();
  [[nodiscard]] Elapsed stop();

  const Api* gl_;
  Stamps stamps_;
  bool has_clock_ = false;  // whether the device has a clock
  Query begin_;
  Query end_;
  double started_ns_ = 0;
};

// Waits until the device has finished all submitted work. Throws core::ApiError or
// core::DeviceLost.
void wait_for_device(const Api& gl);

struct Statistic {
  GLenum target = 0;
  std::string_view name;  // the name in record::Counts
};

// Counts the wanted pipeline statistics while some GL calls are executed. A statistic that the
// driver cannot count is omitted.
class Statistics {
 public:
  Statistics(const Api& gl, std::span<const Statistic> wanted);

  template <class Submit>
  [[nodiscard]] record::Counts count(Submit&& submit) {
    begin();
    submit();
    return end();
  }

 private:
  struct ActiveQuery {
    Statistic statistic;
    Query query;
  };
  void begin();
  [[nodiscard]] record::Counts end();

  const Api* gl_;
  std::vector<ActiveQuery> queries_;
};

}  // namespace triptych::gl_backend
