#pragma once
// Functions that create and read factors, used by all suites.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/suite.hpp"

namespace triptych::measure {

enum class FactorRole : std::uint8_t { scene, method };

[[nodiscard]] Factor choice(std::string name, std::vector<std::string> levels,
                            std::string default_value, FactorRole role, std::string summary);
// Creates a numeric factor. `words` are named values that may be used instead of a number. The
// suite defines their meaning.
[[nodiscard]] Factor number(std::string name, double minimum, double maximum,
                            std::string default_value, FactorRole role, std::string summary,
                            std::vector<std::string> words = {});
// Creates a factor whose values are strings that Suite::check() checks. Such a factor counts as a
// part of the scene (Factor::determines_image), because its value determines the image.
[[nodiscard]] Factor text(std::string name, std::string default_value, std::string summary);

// Returns the factor `technique` of a suite. Its levels are the suite's techniques, in the order of
// the catalogue. "auto" stands for all techniques that draw an image.
[[nodiscard]] Factor technique_factor(std::string_view suite, std::string default_value,
                                      std::string summary);

// Parses "N" or "WxH" to {width, height}. Throws InputError.
[[nodiscard]] std::array<int, 2> parse_viewport(std::string_view value);

// Returns the value of a numeric factor.
[[nodiscard]] double as_number(const Configuration& configuration, const std::string& factor);

// Returns the camera as it is written to the key "camera" of frame.json, which `triptych render`
// writes for other programs.
[[nodiscard]] nlohmann::json camera_json(const scene::Camera& camera);

}  // namespace triptych::measure
