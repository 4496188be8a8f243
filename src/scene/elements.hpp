#pragma once
// Chemical elements, with the radii and colours of their atoms.

#include <optional>
#include <string>
#include <string_view>

#include "scene/particle_colours.hpp"

namespace triptych::scene {

// The atomic number of a symbol in any case, such as "Cl" or "CL"; D and T are hydrogen.
[[nodiscard]] std::optional<int> atomic_number(std::string_view symbol);
// The symbol of an element, for atomic numbers from 1 to 118.
[[nodiscard]] std::optional<std::string_view> symbol_of(int atomic_number);

// Van der Waals radius in ångström (Bondi 1964); 2.0 for elements that are not listed there and for
// unknown symbols.
[[nodiscard]] double van_der_waals_radius(std::string_view symbol);

// The colours of Corey, Pauling and Koltun: carbon is grey, nitrogen blue, oxygen red and so on.
// Elements without such a colour, and unknown symbols, get hues that are far apart.
[[nodiscard]] Rgb element_colour(std::string_view symbol);

// A symbol in the usual spelling, such as "Cl" for "CL".
[[nodiscard]] std::string proper_symbol(std::string_view symbol);

}  // namespace triptych::scene
