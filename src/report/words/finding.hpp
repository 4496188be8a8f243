#pragma once
// All sentences about findings, verdicts and advice. The sentences contain messages from drivers
// and names of data files, so callers must escape them for the output format.
//
// To add a cause, add a value to judge::Cause and to its table of names (judge/finding.cpp), and a
// case to the switch in words/observation.cpp. The compiler warns if the switch lacks the value.

#include <string>
#include <string_view>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::report::words {

// Describes an observation in one sentence: "16 of 36864 pixels exceed the error bound of the
// reference image; …".
[[nodiscard]] std::string text_of(const judge::Observation& what);

// Returns the finding's sentence, together with the waiver that excuses the finding and the result
// of drawing the configuration again.
[[nodiscard]] std::string found(const judge::Finding& finding);
// Returns the beginning of found() that names the waiver, or the entry in the file of expectations,
// that excuses the finding: "waived until 2027-01-01 (REASON): ". Returns "" if there is none.
[[nodiscard]] std::string excuse(const judge::Finding& finding);
// Returns the next step that the reader should take, or "" if there is none.
[[nodiscard]] std::string advice(const judge::Finding& finding);
// Returns found() and advice() in one line.
[[nodiscard]] std::string text_of(const judge::Finding& finding);

// Returns the name and the version of the driver: "llvmpipe Mesa 22.3.6 (LLVM 15.0.6)".
[[nodiscard]] std::string driver_text(const judge::TestedDevice& device);
// Describes a changed value: "instructions in generated code 1000 → 1001 (+0.1 %)".
[[nodiscard]] std::string text_of(const judge::Change& change);
// Returns why a correlation line is refused, or "" if it is not.
[[nodiscard]] std::string refusal(const judge::CorrelationLine& line);

// Summarizes a result: "FAIL: 2 regressions in image on vulkan:lavapipe; 96 checks, 4 devices".
[[nodiscard]] std::string headline(const judge::GateResult& result);

}  // namespace triptych::report::words
