#pragma once
// The paper's figures of one's own records, as one self-contained HTML page.

#include <string>
#include <vector>

#include "analysis/analysis.hpp"

namespace triptych::report {

// Every figure states the factors that were held and the number of samples; what could not be
// computed is listed with its reason.
[[nodiscard]] std::string analysis_page(const std::vector<analysis::SuiteAnalysis>& analyses);

}  // namespace triptych::report
