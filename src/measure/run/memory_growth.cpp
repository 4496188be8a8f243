#include "measure/run/memory_growth.hpp"

#include <algorithm>

namespace triptych::measure {

void MemoryGrowth::restart() {
  *this = {};
}

bool MemoryGrowth::add(const Job& job, std::uint64_t peak_bytes) {
  drawn_.push_back({job, peak_bytes});
  if (drawn_.size() > window + 1) drawn_.erase(drawn_.begin());
  // The growth of the first configuration of a worker is unknown.
  if (drawn_.size() > 1) ++since_;
  if (drawn_.size() <= window || since_ < least_) return false;
  std::vector<std::uint64_t> growth;
  for (std::size_t i = 1; i < drawn_.size(); ++i) {
    const std::uint64_t before = drawn_[i - 1].peak_bytes;
    growth.push_back(drawn_[i].peak_bytes - std::min(before, drawn_[i].peak_bytes));
  }
  const auto median = growth.begin() + window / 2;
  std::ranges::nth_element(growth, median);
  return *median > suspicious_growth;
}

std::vector<Job> MemoryGrowth::repeats() const {
  std::vector<Job> jobs{drawn_.back().job};
  for (std::size_t i = drawn_.size() - window; i < drawn_.size(); ++i) {
    jobs.push_back(drawn_[i].job);
  }
  for (Job& job : jobs) {
    job.protocol.measure_every = true;  // the worker must not reuse the first results
    job.report_resident = true;
  }
  return jobs;
}

std::optional<std::uint64_t> MemoryGrowth::leak(std::span<const std::uint64_t> resident_bytes) {
  const std::uint64_t before = resident_bytes.front();
  const std::uint64_t after = std::max(before, resident_bytes.back());
  const std::uint64_t growth = (after - before) / window;
  if (growth > leaking_growth) return growth;
  since_ = 0;
  least_ *= 2;
  return std::nullopt;
}

}  // namespace triptych::measure
