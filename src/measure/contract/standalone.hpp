#pragma once
// Generates parts of the C program that `render --dump` writes. The program draws one frame and
// prints one of its pixels. Each backend has a template of the program for its API.

#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "core/image.hpp"

namespace triptych::measure {

// Returns "static const uint32_t NAME[N] = {…};" in a few long lines. The last word is padded with
// zeros.
[[nodiscard]] std::string c_words(std::string_view name, std::span<const std::byte> bytes);

// Returns "static const char NAME[] = …;", where the text is written as string literals.
[[nodiscard]] std::string c_text(std::string_view name, std::string_view text);

// The C function `judge`, which prints a pixel, compares it with the expected value, and returns
// the exit code of the program. The expected values are missing until append_expected() adds them.
// The program also compiles without them, because the frame may crash before they can be added. The
// template must define `width` before this function.
inline constexpr std::string_view c_judge =
    R"c(/* The image of the reference renderer and the bound of each pixel and channel, as floats. The end of
   this file contains their values, unless the frame crashed or hung, or has more than 65536 pixels. */
const uint32_t *expected_image, *expected_bound;

static int judge(int x, int y, const float *pixel) {
  const size_t at = 4 * ((size_t)y * width + x);
  float expected[4], bound[4];
  int c, wrong = 0;
  printf("pixel (%d, %d): %.9g %.9g %.9g %.9g\n", x, y, pixel[0], pixel[1], pixel[2], pixel[3]);
  if (expected_image == NULL) return 0;
  memcpy(expected, expected_image + at, sizeof expected);
  memcpy(bound, expected_bound + at, sizeof bound);
  printf("expected: %.9g %.9g %.9g %.9g\n", expected[0], expected[1], expected[2], expected[3]);
  printf("bound: %.3g %.3g %.3g %.3g\n", bound[0], bound[1], bound[2], bound[3]);
  for (c = 0; c < 4; ++c) {
    const double error = (double)pixel[c] - expected[c];
    if (!(error <= bound[c] && -error <= bound[c])) wrong = 1;
  }
  puts(wrong ? "wrong: the error exceeds the bound" : "correct: the error is within the bound");
  return wrong;
}
)c";

// Appends the expected values to frame.c in the dump folder. Does nothing if there is no frame.c,
// or if the image is so large that compiling the program would take long.
void append_expected(const std::filesystem::path& folder, const core::Image& truth,
                     const core::Image& bound);

// Returns the template with each "@NAME@" replaced by its value. Throws std::out_of_range if a name
// has no value.
[[nodiscard]] std::string fill_template(std::string_view text,
                                        const std::map<std::string, std::string>& values);

}  // namespace triptych::measure
