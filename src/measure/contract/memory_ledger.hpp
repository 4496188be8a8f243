#pragma once
// Tracks the memory that a backend uses on its device. Each buffer and each image has an entry.

#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>

#include "record/record.hpp"

namespace triptych::measure {

class MemoryLedger {
  struct Sums {
    std::atomic<std::uint64_t> buffers{0};
    std::atomic<std::uint64_t> images{0};
    std::atomic<std::uint64_t> moved{0};
  };
  using Sum = std::atomic<std::uint64_t> Sums::*;

 public:
  // Counts the bytes of one object until the entry is destroyed. An entry may outlive the ledger,
  // and may be destroyed on any thread, for example in a driver's callback.
  class Entry {
   public:
    Entry() = default;
    Entry(Entry&& other) noexcept { swap(other); }
    Entry& operator=(Entry&& other) noexcept {
      Entry moved(std::move(other));
      swap(moved);
      return *this;
    }
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;
    ~Entry() {
      if (sums_) *sums_.*sum_ -= bytes_;
    }

   private:
    friend class MemoryLedger;
    Entry(std::shared_ptr<Sums> sums, Sum sum, std::uint64_t bytes)
        : sums_(std::move(sums)), sum_(sum), bytes_(bytes) {
      *sums_.*sum_ += bytes_;
    }
    void swap(Entry& other) noexcept {
      std::swap(sums_, other.sums_);
      std::swap(sum_, other.sum_);
      std::swap(bytes_, other.bytes_);
    }
    std::shared_ptr<Sums> sums_;
    Sum sum_ = &Sums::buffers;
    std::uint64_t bytes_ = 0;
  };

  [[nodiscard]] Entry buffer(std::uint64_t bytes) const { return {sums_, &Sums::buffers, bytes}; }
  [[nodiscard]] Entry image(std::uint64_t bytes) const { return {sums_, &Sums::images, bytes}; }
  // Counts bytes that are uploaded to the device again in every frame. Keep the entry alive for as
  // long as frames with this upload are drawn.
  [[nodiscard]] Entry moved(std::uint64_t bytes) const { return {sums_, &Sums::moved, bytes}; }

  // Returns the counts in the form that Device::memory() returns.
  [[nodiscard]] record::Counts counts() const {
    record::Counts counts{{"buffers", sums_->buffers}, {"images", sums_->images}};
    if (sums_->moved > 0) counts.emplace("moved", sums_->moved);
    return counts;
  }

 private:
  std::shared_ptr<Sums> sums_ = std::make_shared<Sums>();
};

}  // namespace triptych::measure
