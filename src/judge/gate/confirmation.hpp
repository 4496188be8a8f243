#pragma once
// What is doubtful in one launch is settled by another.
//
// What runs beside a frame only lengthens it, and goes away; a slowdown of the program stays. So a
// fresh launch is more rounds, minutes later: of a configuration's launches the quieter one counts,
// as of a launch's rounds, and the whole run is judged once more by what is left. That is one test
// of one set of times, with the power of the quieter of two launches. Asking each launch for itself
// would find what both find, the power squared, and p-values of launches may not be multiplied:
// what the stored runs, the other device and the line are off by is in both.

#include <set>
#include <span>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::judge {

// The devices on which `again` measured all that they measured here, by the same code and data:
// after half of it, a slowdown that is missed may not have been measured.
[[nodiscard]] std::set<std::string> measured_again(std::span<const record::Record> records,
                                                   const Launch& again);

// Gives each record of these devices the times of the quieter launch and the rounds of both.
// `again`: of the other launch. Clocks that differ are left for the wall clock.
void join_launches(std::vector<record::Record>& records, std::span<const record::Record> again,
                   const std::set<std::string>& devices);

// The devices on which something looks slower than chance alone often makes it, or a stored device
// cannot judge for noise: what a launch more would tell. It asks for less than a regression does,
// as that is what the next launch is for.
[[nodiscard]] std::set<std::string> devices_in_doubt(const GateResult& result);

// Of the first launch's regressions in time: those that all launches together show too say so, and
// what is left of the others is told as advice.
void tell_what_was_taken_back(const GateResult& first, GateResult& all);

}  // namespace triptych::judge
