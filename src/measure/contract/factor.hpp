#pragma once
// What the suites' lists of factors have in common.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/suite.hpp"

namespace triptych::measure {

enum class Decides : std::uint8_t { the_picture, how_it_is_made };

[[nodiscard]] Factor choice(std::string name, std::vector<std::string> levels, std::string standard,
                            Decides decides, std::string summary);
// `words`: values that stand for a number which the suite knows.
[[nodiscard]] Factor number(std::string name, double minimum, double maximum, std::string standard,
                            Decides decides, std::string summary,
                            std::vector<std::string> words = {});
// Its values are checked by Suite::check. It decides the picture.
[[nodiscard]] Factor text(std::string name, std::string standard, std::string summary);

// The factor `technique` of a suite: the catalogue's, in its order. "auto" are those that draw a
// picture.
[[nodiscard]] Factor technique_factor(std::string_view suite, std::string standard,
                                      std::string summary);

// "N" or "WxH" → {width, height}; throws InputError.
[[nodiscard]] std::array<int, 2> parse_viewport(std::string_view value);

// The value of a factor of kind number.
[[nodiscard]] double as_number(const Configuration& configuration, const std::string& factor);

// "camera" of frame.json.
[[nodiscard]] nlohmann::json camera_json(const scene::Camera& camera);

}  // namespace triptych::measure
