#pragma once
// The gate's own-history check and its cross-device correlation, tried on stored runs.

#include <cstdint>
#include <filesystem>

#include "judge/evaluation/bench.hpp"
#include "judge/evaluation/evaluation.hpp"

namespace triptych::judge {

struct RunTrials {
  std::size_t most = 40;  // trials of one kind on one device, where the pool has so many
  std::uint64_t seed = 1;
  bool history = true;
  bool correlation = true;
};

// Trials put together from a plan's pooled runs, each judged by the gate with the baselines that
// the other unplanted runs make:
// - A/A: every unplanted run as it is. It is also judged with all times, anchors' too, longer by
//   each planted size (a slower device), and with one device's times exchanged among its
//   configurations (to be refused).
// - one configuration, one level: an unplanted run in which these records are those of the planted
//   run measured next to it. In every other trial of one configuration the counters of work are
//   raised by what was planted, else they are the unplanted ones: more work, or more time for the
//   same work.
// - one API, everything: all records, and the anchors measured with them.
// Devices in doubt are then judged by a second launch as well, as under CTest: the unplanted run
// measured next, or the same made of the next planted run of that size; of the last, of the one
// before it. Neither is among the runs that they are judged by. A store with one planted run of a
// size has no second one: nothing of it is counted as confirmed; nor where fewer than
// TimingModel::least_runs would be left. No trial is made twice. `folder` must be empty; it is for
// files. Deterministic in the pool and the seed. A pool of fewer than two unplanted runs gives
// nothing.
[[nodiscard]] Tallies evaluate_runs(const RunPool& pool, const RunTrials& trials,
                                    const std::filesystem::path& folder);

}  // namespace triptych::judge
