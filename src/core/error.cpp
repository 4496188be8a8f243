#include "core/error.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace triptych::core {
namespace {

std::string describe(const FilePlace& place, const std::string& message) {
  std::string text = place.file;
  if (place.line > 0) text += fmt::format(":{}", place.line);
  if (place.column > 0) text += fmt::format(":{}", place.column);
  return text.empty() ? message : text + ": " + message;
}

std::string_view file_name(std::string_view path) {
  const auto slash = path.find_last_of('/');
  return slash == std::string_view::npos ? path : path.substr(slash + 1);
}

// Device-code compilers report many lines, but what() must be one line.
std::string on_one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (c != '\n' && c != '\r') {
      line += c;
    } else if (!line.empty() && !line.ends_with(" | ")) {
      line += " | ";
    }
  }
  while (line.ends_with(" | ")) line.resize(line.size() - 3);
  return line;
}

}  // namespace

InputError::InputError(FilePlace place, const std::string& message)
    : Error(describe(place, message)), place_(std::move(place)) {}

ApiError::ApiError(std::string call, std::string code, const std::string& detail,
                   core::CodePlace place)
    : Error(fmt::format("{} returned {} at {}:{}{}{}", call, code, file_name(place.file_name()),
                        place.line(), detail.empty() ? "" : ": ", on_one_line(detail))),
      call_(std::move(call)),
      code_(std::move(code)) {}

}  // namespace triptych::core
