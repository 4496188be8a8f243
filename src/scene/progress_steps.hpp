#pragma once
#include <algorithm>
#include <cstdint>

#include "scene/particles.hpp"

namespace triptych::scene {

// Calls a Progress function at most once for each per cent of the work, no matter how often
// advance_to() is called.
class ProgressSteps {
 public:
  // `progress` may be empty. If the work is part of a larger task, its progress is mapped to
  // [begin, end].
  ProgressSteps(const Progress& progress, std::uint64_t total, double begin = 0, double end = 1)
      : progress_(progress), total_(std::max<std::uint64_t>(total, 1)), begin_(begin), end_(end) {}

  void advance_to(std::uint64_t done) {
    if (done < next_) return;
    next_ = done + std::max<std::uint64_t>(total_ / 100, 1);
    if (!progress_) return;
    const double share = static_cast<double>(std::min(done, total_)) / static_cast<double>(total_);
    progress_(begin_ + (end_ - begin_) * share);
  }

 private:
  const Progress& progress_;
  std::uint64_t total_;
  double begin_;
  double end_;
  std::uint64_t next_ = 0;
};

}  // namespace triptych::scene
