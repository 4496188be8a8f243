#pragma once
// Generates parts of the C program that `render --dump` writes. The program draws one frame and
// prints one of its pixels. Each backend has a template of the program for its API.

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace triptych::measure {

// Returns "static const uint32_t NAME[N] = {…};" in a few long lines. The last word is padded with
// zeros.
[[nodiscard]] std::string c_words(std::string_view name, std::span<const std::byte> bytes);

// Returns "static const char NAME[] = …;", where the text is written as string literals.
[[nodiscard]] std::string c_text(std::string_view name, std::string_view text);

// Returns the template with each "@NAME@" replaced by its value. Throws std::out_of_range if a name
// has no value.
[[nodiscard]] std::string fill_template(std::string_view text,
                                        const std::map<std::string, std::string>& values);

}  // namespace triptych::measure
