#pragma once
// Which anchors were measured beside a run: what shows how its devices did at that time.

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "judge/gate/run_view.hpp"

namespace triptych::judge {

// Of these runs of anchors_plan the latest that began before `run` did, by their ids, which begin
// with the time; nullopt where that was more than an hour before, as a machine does not stay as it
// is.
[[nodiscard]] std::optional<std::string> anchors_beside(const std::string& run,
                                                        const std::set<std::string>& anchor_runs);

// Whether there is a time that a logarithm can be taken of.
[[nodiscard]] bool has_time(const record::Record& record);

// The anchors beside the run, of the very devices that are judged: another driver is another
// device. Their times are the quieter ones of all launches, as the run's are. Empty where none were
// measured beside it.
[[nodiscard]] std::vector<record::Record> anchors_of(const RunView& view);

}  // namespace triptych::judge
