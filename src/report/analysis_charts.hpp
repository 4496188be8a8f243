#pragma once
// The analysis' figures, SVG. Each takes rows of the tables in analysis/tables.hpp; what is
// null in them is not drawn. Empty where nothing is left.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/json.hpp"

namespace triptych::report {

// Bars of one histogram and the fit's expectation as a line; rows of `histograms`.
[[nodiscard]] std::string histogram_chart(const core::Json& bins, bool logarithmic);
// Every r as a stroke, a box of the quartiles where a factor has three or more; rows of
// `correlations`.
[[nodiscard]] std::string correlation_boxes_chart(const core::Json& cells);
// One factor's matrix as a heat map; rows of `correlations`.
[[nodiscard]] std::string correlation_matrix_chart(const core::Json& cells);
// Rows of `mean_times` of one pair of factors, ms.
[[nodiscard]] std::string mean_times_chart(const core::Json& cells);
// Bars with (1 − r)·s as error bars; rows of `speed_ups` of one factor.
[[nodiscard]] std::string speed_ups_chart(const core::Json& rows);

}  // namespace triptych::report
