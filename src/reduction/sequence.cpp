#include "reduction/sequence.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

namespace triptych::reduction {
namespace {

class SequenceSearch {
 public:
  SequenceSearch(std::size_t most_frames, const FailsAfter& fails_after,
                 const std::function<void(std::size_t)>& on_shorter)
      : frames_left_(most_frames), fails_after_(fails_after), on_shorter_(on_shorter) {}

  std::optional<Sequence> run(std::size_t count) {
    if (!find_failing_suffix(count)) return std::nullopt;
    remove_parts();
    return std::move(result_);
  }

 private:
  // Tries the last 1, 2, 4, … configurations of the list, because the culprit is often drawn
  // shortly before the frame.
  bool find_failing_suffix(std::size_t count) {
    for (std::size_t length = 1; length < count; length *= 2) {
      if (attempt(suffix(count, length))) return true;
    }
    // The whole list is tried even if the limit on the number of frames has been reached.
    frames_left_ = std::max(frames_left_, count + 1);
    return count > 0 && attempt(suffix(count, count));
  }

  static Positions suffix(std::size_t count, std::size_t length) {
    Positions positions(length);
    std::iota(positions.begin(), positions.end(), count - length);
    return positions;
  }

  // Divides the sequence into parts and leaves out one part after the other. If the frame fails
  // without a part, continues with the shorter sequence, otherwise with smaller parts.
  void remove_parts() {
    std::size_t parts = 2;
    while (result_.before.size() > 1 && result_.complete) {
      parts = std::min(parts, result_.before.size());
      if (remove_one_part_of(parts)) {
        parts = std::max<std::size_t>(parts - 1, 2);
      } else if (parts == result_.before.size()) {
        return;
      } else {
        parts *= 2;
      }
    }
  }

  bool remove_one_part_of(std::size_t parts) {
    const Positions whole = result_.before;
    const auto at = [&](std::size_t part) {
      return whole.begin() + static_cast<std::ptrdiff_t>(part * whole.size() / parts);
    };
    for (std::size_t part = 0; part < parts; ++part) {
      Positions remaining(whole.begin(), at(part));
      remaining.insert(remaining.end(), at(part + 1), whole.end());
      if (attempt(std::move(remaining))) return true;
    }
    return false;
  }

  bool attempt(Positions before) {
    const std::size_t frames = before.size() + 1;
    if (frames > frames_left_) {
      result_.complete = false;
      return false;
    }
    // A sequence that was tried before, but is not the result so far, did not make the frame fail.
    if (!tried_.insert(before).second) return false;
    frames_left_ -= frames;
    if (!fails_after_(before)) return false;
    result_.before = std::move(before);
    on_shorter_(result_.before.size());
    return true;
  }

  std::size_t frames_left_;
  std::set<Positions> tried_;
  const FailsAfter& fails_after_;
  const std::function<void(std::size_t)>& on_shorter_;
  Sequence result_;
};

}  // namespace

std::optional<Sequence> shortest_sequence(std::size_t count, std::size_t most_frames,
                                          const FailsAfter& fails_after,
                                          const std::function<void(std::size_t)>& on_shorter) {
  return SequenceSearch(most_frames, fails_after, on_shorter).run(count);
}

}  // namespace triptych::reduction
