#include "measure/contract/loading.hpp"

#include <set>
#include <string>
#include <utility>

namespace triptych::measure {
namespace {

class Pace {
 public:
  Pace(OnLoading tell, std::function<std::chrono::steady_clock::time_point()> now)
      : tell_(std::move(tell)), now_(std::move(now)) {}

  void operator()(const Loading& loading) {
    if (!loading.note.empty()) {
      // Reports each note only once, because the same data may be loaded again, for example in
      // another voxel format.
      if (notes_.insert(loading.what + ": " + loading.note).second) tell_(loading);
      return;
    }
    const auto now = now_();
    if (loading.what != last_.what || loading.share < last_.share) {
      rested_since_ = now;
      told_ = false;
    }
    last_ = loading;
    if (loading.share >= 1) {
      if (std::exchange(told_, false)) tell_(loading);
    } else if (now - rested_since_ >= pause) {
      rested_since_ = now;
      told_ = true;
      tell_(loading);
    }
  }

 private:
  static constexpr std::chrono::seconds pause{2};

  OnLoading tell_;
  std::function<std::chrono::steady_clock::time_point()> now_;
  Loading last_{.what = {}, .share = 1};
  std::chrono::steady_clock::time_point rested_since_;
  bool told_ = false;
  std::set<std::string> notes_;  // notes that were already reported
};

}  // namespace

OnLoading paced(OnLoading tell, std::function<std::chrono::steady_clock::time_point()> now) {
  return Pace(std::move(tell), std::move(now));
}

}  // namespace triptych::measure
