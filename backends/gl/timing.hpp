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

// Where the device's time stamps stand.
enum class Stamps : std::uint8_t {
  in_stream,  // right before and after the work, as GPUs execute them
  finished    // the work is finished before the second is asked for: software renderers run compute
              // and their stamps on different threads, and stamps in stream read about nothing
};

// Times work by the wall and by the device.
class Stopwatch {
 public:
  Stopwatch(const Api& gl, Stamps stamps);

  // `submit` makes the GL calls to be timed; the wall clock runs from before them until the device
  // has signalled a fence behind them, waited for without spinning.
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
  bool offered_ = false;  // the device has a clock
  Query begin_;
  Query end_;
  double started_ns_ = 0;
};

// Waits until the device has done everything submitted. Throws core::ApiError, core::DeviceLost.
void wait_for_device(const Api& gl);

struct Statistic {
  GLenum target = 0;
  std::string_view name;  // as record::Counts has it
};

// The driver's pipeline statistics of some calls, for the stages they use; what it cannot tell is
// absent.
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
  struct Asked {
    Statistic what;
    Query query;
  };
  void begin();
  [[nodiscard]] record::Counts end();

  const Api* gl_;
  std::vector<Asked> asked_;
};

}  // namespace triptych::gl_backend
