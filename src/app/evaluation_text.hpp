#pragma once
// What an evaluation found, for people and for programs.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "judge/evaluation/evaluation.hpp"

namespace triptych::app {

// A table of all kinds of trials, the smallest sizes found, the aims. Rates are "share [low, high]
// hits/trials" with Clopper and Pearson's 95 % interval.
[[nodiscard]] std::string to_text(const judge::Tallies& tallies);

// {"trials": [{"method", "plan", "subject", "spread", "percent", RATE…,
// "seconds_per_configuration"}], "smallest_found": […], "aims": [{"aim", "bound", "at_least",
// "met", …RATE}]}; RATE is {"hits", "trials", "share", "low", "high"}, left out where nothing was
// tried.
[[nodiscard]] nlohmann::json to_json(const judge::Tallies& tallies);

}  // namespace triptych::app
