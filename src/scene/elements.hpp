#pragma once
// Chemical elements, with the radii and colours of their atoms.

#include <optional>
#include <string>
#include <string_view>

#include "scene/particle_colours.hpp"

namespace triptych::scene {

// Returns the atomic number of a symbol, such as "Cl". Upper and lower case do not matter. D and T
// are hydrogen.
[[nodiscard]] std::optional<int> atomic_number(std::string_view symbol);
// Returns the symbol of an element with an atomic number from 1 to 118, or nullopt for other
// numbers.
[[nodiscard]] std::optional<std::string_view> symbol_of(int atomic_number);

// Returns the van der Waals radius in ångström (Bondi 1964), or 2.0 for unknown symbols and for
// elements without a radius in Bondi's table.
[[nodiscard]] double van_der_waals_radius(std::string_view symbol);

// Returns the element's colour according to Corey, Pauling and Koltun: carbon is grey, nitrogen
// blue, oxygen red and so on. Elements without such a colour, and unknown symbols, get distinct
// hues.
[[nodiscard]] Rgb element_colour(std::string_view symbol);

// Returns a symbol in its usual spelling, such as "Cl" for "CL".
[[nodiscard]] std::string proper_symbol(std::string_view symbol);

}  // namespace triptych::scene
