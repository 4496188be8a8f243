#pragma once
// A frame may be correct if it is drawn alone, but fail if other frames are drawn before it. The
// function in this file finds the earlier frames that make it fail, by delta debugging (Zeller and
// Hildebrandt, "Simplifying and Isolating Failure-Inducing Input", 2002).

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace triptych::reduction {

// Positions of configurations in a list, in increasing order.
using Positions = std::vector<std::size_t>;

// A function that draws the configurations at these positions and then the frame, all in one new
// process. Returns whether the frame fails.
using FailsAfter = std::function<bool(const Positions&)>;

struct Sequence {
  Positions before;
  bool complete = true;  // false if the search reached `most_frames`, so that a shorter sequence
                         // may also make the frame fail
};

// Finds a sequence of configurations, out of a list of `count`, after which the frame fails. If the
// result is complete, the frame no longer fails if any one configuration is left out. Draws at most
// `most_frames` frames, but always tries the whole list. Calls `on_shorter` with the length of each
// shorter sequence that it finds. Returns nullopt if the frame does not fail after the whole list.
[[nodiscard]] std::optional<Sequence> shortest_sequence(
    std::size_t count, std::size_t most_frames, const FailsAfter& fails_after,
    const std::function<void(std::size_t)>& on_shorter);

}  // namespace triptych::reduction
