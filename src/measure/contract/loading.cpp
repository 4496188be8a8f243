#include "measure/contract/loading.hpp"

#include <set>
#include <string>
#include <utility>

namespace triptych::measure {
namespace {

class Throttle {
 public:
  Throttle(OnLoading forward, std::function<std::chrono::steady_clock::time_point()> now)
      : forward_(std::move(forward)), now_(std::move(now)) {}

  void operator()(const Loading& loading) {
    if (!loading.note.empty()) {
      // Reports each note only once, because the same data may be loaded again, for example in
      // another voxel format.
      if (notes_.insert(loading.what + ": " + loading.note).second) forward_(loading);
      return;
    }
    const auto now = now_();
    if (loading.what != last_.what || loading.share < last_.share) {
      last_time_ = now;
      reported_ = false;
    }
    last_ = loading;
    if (loading.share >= 1) {
      if (std::exchange(reported_, false)) forward_(loading);
    } else if (now - last_time_ >= interval) {
      last_time_ = now;
      reported_ = true;
      forward_(loading);
    }
  }

 private:
  static constexpr std::chrono::seconds interval{2};

  OnLoading forward_;
  std::function<std::chrono::steady_clock::time_point()> now_;
  Loading last_{.what = {}, .share = 1};
  std::chrono::steady_clock::time_point last_time_;
  bool reported_ = false;
  std::set<std::string> notes_;  // notes that were already reported
};

}  // namespace

OnLoading throttled(OnLoading forward, std::function<std::chrono::steady_clock::time_point()> now) {
  return Throttle(std::move(forward), std::move(now));
}

}  // namespace triptych::measure
