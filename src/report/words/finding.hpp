#pragma once
// All sentences about findings, verdicts and advice. Texts that quote drivers or name data are of
// unknown origin: escape them for the format into which they are written.
//
// To add a cause, add a value to judge::Cause and to its table of names (judge/finding.cpp), and a
// case to the switch in words/observation.cpp. The compiler reports a switch that lacks the value.

#include <string>
#include <string_view>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::report::words {

// One sentence: "16 of 36864 pixels exceed the error bound of the reference image; …".
[[nodiscard]] std::string text_of(const judge::Observation& what);

// The sentence with its excuse and with the result of drawing it again.
[[nodiscard]] std::string found(const judge::Finding& finding);
// The next step for the reader; empty if there is none.
[[nodiscard]] std::string advice(const judge::Finding& finding);
// found() and advice() in one line.
[[nodiscard]] std::string text_of(const judge::Finding& finding);

// "instructions of generated code 1000 → 1001 (+0.1 %)".
[[nodiscard]] std::string text_of(const judge::Change& change);
// The reason why a line is not used; empty if it is used.
[[nodiscard]] std::string refusal(const judge::CorrelationLine& line);

// "FAIL: 2 regressions in image on vulkan:lavapipe; 96 checks, 4 devices".
[[nodiscard]] std::string headline(const judge::GateResult& result);

}  // namespace triptych::report::words
