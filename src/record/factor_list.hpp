#pragma once
// "factor=value,factor=value": the text by which configurations and scenes are known, in stores,
// baselines, patterns and on the command line.

#include <map>
#include <string>
#include <string_view>

namespace triptych::record {

// A value as it stands in a list: '%2C' for a comma, '%3D' for '=', as in addresses (RFC 3986,
// 2.1), so that both always separate and a list may be cut without knowing about values. '%25'
// stands for '%' only where it would otherwise begin one of these three; every other text stands
// for itself.
[[nodiscard]] std::string escaped(std::string_view value);
// The value that is escaped to this text; text that escapes nothing is itself.
[[nodiscard]] std::string unescaped(std::string_view text);

// Sorted by factor, whose names have neither ',' nor '='.
[[nodiscard]] std::string factor_list(const std::map<std::string, std::string>& factors);
// The inverse. What has no '=' names no factor and is left out.
[[nodiscard]] std::map<std::string, std::string> parse_factor_list(std::string_view list);

}  // namespace triptych::record
