#pragma once
// What a gate said of a trial, counted against what was planted.

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "judge/evaluation/evaluation.hpp"
#include "judge/gate/gate.hpp"

namespace triptych::judge {

struct Trial {
  Spread spread = Spread::none;
  double percent = 0;
  std::set<std::pair<std::string, std::string>> planted = {};  // (device, configuration)
  std::pair<std::string, std::string> level = {};              // factor, level; Spread::level only
  double cost = 0;         // of what is planted, measured: see Tally
  double cost_again = 0;   // in the second launch, where there is one
  bool more_work = false;  // Spread::configuration only: else more time for the same work
  bool confirmed = false;  // the result is that of two launches: see TrialKind
};

[[nodiscard]] std::set<std::pair<std::string, std::string>> names_of(
    const std::vector<record::Record>& records);

// The timing check, each device for itself; of the program as a whole too. What cannot be told and
// what was planted cost are counted with the first run only.
void count_history(const std::string& plan, const GateResult& result, const Trial& trial,
                   const std::vector<std::string>& devices, Tallies& tallies);

// Each device by each other stored one, what stood when the device was accepted left out. A level
// is found where it is called slower beyond chance, whether it decides or only advises.
void count_correlations(const std::string& plan, const std::string& method,
                        const GateResult& result, const Trial& trial, Tallies& tallies);
// One of the devices that were judged, by the stored one that decides; where none can judge it, by
// any.
void count_deciding(const std::string& plan, const std::string& method, const std::string& device,
                    const GateResult& result, const Trial& trial, Tallies& tallies);

}  // namespace triptych::judge
