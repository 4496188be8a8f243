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

// The ids of the catalogue's techniques of a suite, in its order.
[[nodiscard]] std::vector<std::string> technique_ids(std::string_view suite);

// "N" or "WxH" → {width, height}; throws InputError.
[[nodiscard]] std::array<int, 2> parse_viewport(std::string_view value);

// The value of a factor of kind number.
[[nodiscard]] double as_number(const Configuration& configuration, const std::string& factor);

// "camera" of frame.json.
[[nodiscard]] nlohmann::json camera_json(const scene::Camera& camera);

}  // namespace triptych::measure
