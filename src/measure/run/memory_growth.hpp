#pragma once
// Decides whether a driver fails to free memory.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "measure/worker/wire.hpp"

namespace triptych::measure {

// Detects a driver that does not free its memory. Growth alone proves nothing: a process also grows
// when it compiles new code, loads new data or fragments its heap, and this growth depends on
// chance. Growth is therefore only a suspicion. It is a leak if the memory in use grows again when
// the worker draws the same configurations again.
//
// Suspicion: in the last `window` configurations, the median growth of the worker's peak memory is
// more than `suspicious_growth`. Most runs are never suspicious, and nothing is drawn again.
//
// Decision: the worker draws repeats(). After each of them, it returns its unused heap memory to
// the operating system, so that its resident memory contains only memory in use. The first and the
// last repeat are the same configuration, so both numbers belong to the same state, and their
// difference is the memory that `window` repeats did not free. Without a leak, the difference
// is below 0.2 MiB for each configuration (lavapipe, whose peak grew by up to 16 MiB each time when
// one configuration was drawn repeatedly). With a leak, it is about as large as the growth that
// caused the suspicion, which is more than 16 MiB. It may be smaller, because a part of that growth
// may come from work that a driver does only once. The limit of 4 MiB is a quarter of the smallest
// suspicious growth, and 20 times the growth without a leak.
class MemoryGrowth {
 public:
  static constexpr std::size_t window = 8;
  static constexpr std::uint64_t suspicious_growth = std::uint64_t{16} << 20U;
  static constexpr std::uint64_t leaking_growth = std::uint64_t{4} << 20U;

  // Forgets everything, because a new worker was started.
  void restart();
  // Adds a configuration that the worker has drawn, and its peak memory after it. Returns whether
  // the growth is suspicious.
  [[nodiscard]] bool add(const Job& job, std::uint64_t peak_bytes);
  // Returns the jobs that the worker has to draw again after a suspicion.
  [[nodiscard]] std::vector<Job> repeats() const;
  // Decides after a suspicion. `resident_bytes` contains the resident memory after each of
  // repeats(). Returns the growth for each configuration if it is a leak. Otherwise, the suspicion
  // is dropped, and the next one needs twice as many configurations, so that a worker that grows
  // for other reasons is examined only a few times.
  [[nodiscard]] std::optional<std::uint64_t> leak(std::span<const std::uint64_t> resident_bytes);

 private:
  struct Drawn {
    Job job;
    std::uint64_t peak_bytes;
  };
  std::vector<Drawn> drawn_;  // the last `window` configurations and the one before them
  std::size_t since_ = 0;     // configurations since the start or the last dropped suspicion
  std::size_t least_ = window;
};

}  // namespace triptych::measure
