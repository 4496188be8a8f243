#pragma once
// "factor=value,factor=value": the text that names configurations and scenes in stores, baselines
// and patterns, and on the command line.

#include <map>
#include <string>
#include <string_view>

namespace triptych::record {

// The form of a value in a list. A comma becomes '%2C' and '=' becomes '%3D', as in URLs (RFC 3986,
// 2.1). Therefore both characters always separate, and a list can be split without knowing the
// values. '%' becomes '%25' only if it would otherwise begin one of these three sequences. All
// other text is unchanged.
[[nodiscard]] std::string escaped(std::string_view value);
// The inverse of escaped(). A text without an escape sequence is unchanged.
[[nodiscard]] std::string unescaped(std::string_view text);

// Joins the factors, sorted by name. Names contain neither ',' nor '='.
[[nodiscard]] std::string factor_list(const std::map<std::string, std::string>& factors);
// The inverse of factor_list(). A part without '=' is ignored.
[[nodiscard]] std::map<std::string, std::string> parse_factor_list(std::string_view list);

}  // namespace triptych::record
