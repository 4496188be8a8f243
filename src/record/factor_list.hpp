#pragma once
// Reads and writes lists of the form "factor=value,factor=value". Such lists identify
// configurations and scenes in stores, in baselines, in patterns and on the command line.

#include <map>
#include <string>
#include <string_view>

namespace triptych::record {

// Escapes a value for use in a list. A comma becomes '%2C' and '=' becomes '%3D', as in URLs (RFC
// 3986, 2.1). In a list, both characters are therefore always separators, and a list can be split
// without knowing the values. '%' becomes '%25', but only where the value contains '%2C', '%3D' or
// '%25'. All other characters are unchanged.
[[nodiscard]] std::string escaped(std::string_view value);
// The inverse of escaped(). Text without an escape sequence is unchanged.
[[nodiscard]] std::string unescaped(std::string_view text);

// Joins the factors, sorted by name. Names contain neither ',' nor '='.
[[nodiscard]] std::string factor_list(const std::map<std::string, std::string>& factors);
// The inverse of factor_list(). A part without '=' is ignored.
[[nodiscard]] std::map<std::string, std::string> parse_factor_list(std::string_view list);

}  // namespace triptych::record
