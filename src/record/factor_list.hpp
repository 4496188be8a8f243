#pragma once
// "factor=value,factor=value": the text that names configurations and scenes in stores, baselines
// and patterns, and on the command line.

#include <map>
#include <string>
#include <string_view>

namespace triptych::record {

// A value as it is written in a list. A comma becomes '%2C' and '=' becomes '%3D', as in addresses
// (RFC 3986, 2.1). So both characters always separate, and a list can be cut without knowing the
// values. '%' becomes '%25' only where it would otherwise begin one of these three; every other
// text stands for itself.
[[nodiscard]] std::string escaped(std::string_view value);
// The value that is written as this text. A text without an escape is its own value.
[[nodiscard]] std::string unescaped(std::string_view text);

// Sorted by the factors, whose names contain neither ',' nor '='.
[[nodiscard]] std::string factor_list(const std::map<std::string, std::string>& factors);
// The inverse. A part without '=' names no factor and is left out.
[[nodiscard]] std::map<std::string, std::string> parse_factor_list(std::string_view list);

}  // namespace triptych::record
