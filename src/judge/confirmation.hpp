#pragma once
// A suspect of one launch is held against a second one.

#include <set>
#include <string>

#include "judge/gate.hpp"

namespace triptych::judge {

// The devices with a regression in time.
[[nodiscard]] std::set<std::string> suspects(const GateResult& result);

// Whether anything is called slower, advice included: that, or what a stored device's line does not
// let expect.
[[nodiscard]] bool names_suspects(const GateResult& result);

// One launch on a busy machine makes suspects; a slowdown of the program is there on a fresh one
// too. What `again`, the same gate's word on another launch, does not call slower as well – the
// same configuration, level or program on the same device, by the same check and stored device –
// becomes advice. What is no time, and devices that were not measured again, are left as they are.
// It can take findings back and never adds any.
void take_back_unconfirmed(GateResult& result, const GateResult& again);

}  // namespace triptych::judge
