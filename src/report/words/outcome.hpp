#pragma once
// Sentences about the outcome of measuring a configuration (crashed, skipped, …), and about how
// exactly a driver counts a statistic. The sentences contain messages from drivers, so callers must
// escape them.

#include <string>

#include "record/reason.hpp"
#include "record/statistic_worth.hpp"

namespace triptych::report::words {

// Describes why a configuration was not measured: "no answer within 60 s", "the worker was killed
// by SIGSEGV (Segmentation fault)".
[[nodiscard]] std::string text_of(const record::Reason& reason);
// Like text_of(reason), but begins with the outcome: "hung: no answer within 60 s".
[[nodiscard]] std::string text_of(record::Outcome outcome, const record::Reason& reason);

// Describes how exactly a driver counts a statistic: "exact", "1.18 to 3.88 times the correct count
// (…)".
[[nodiscard]] std::string text_of(const record::StatisticWorth& worth);

}  // namespace triptych::report::words
