#include "scene/elements.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "scene/text_lines.hpp"

namespace triptych::scene {
namespace {

// The symbols of the elements, in the order of their atomic numbers.
constexpr std::array<std::string_view, 118> symbols{
    "H",  "He", "Li", "Be", "B",  "C",  "N",  "O",  "F",  "Ne", "Na", "Mg", "Al", "Si", "P",
    "S",  "Cl", "Ar", "K",  "Ca", "Sc", "Ti", "V",  "Cr", "Mn", "Fe", "Co", "Ni", "Cu", "Zn",
    "Ga", "Ge", "As", "Se", "Br", "Kr", "Rb", "Sr", "Y",  "Zr", "Nb", "Mo", "Tc", "Ru", "Rh",
    "Pd", "Ag", "Cd", "In", "Sn", "Sb", "Te", "I",  "Xe", "Cs", "Ba", "La", "Ce", "Pr", "Nd",
    "Pm", "Sm", "Eu", "Gd", "Tb", "Dy", "Ho", "Er", "Tm", "Yb", "Lu", "Hf", "Ta", "W",  "Re",
    "Os", "Ir", "Pt", "Au", "Hg", "Tl", "Pb", "Bi", "Po", "At", "Rn", "Fr", "Ra", "Ac", "Th",
    "Pa", "U",  "Np", "Pu", "Am", "Cm", "Bk", "Cf", "Es", "Fm", "Md", "No", "Lr", "Rf", "Db",
    "Sg", "Bh", "Hs", "Mt", "Ds", "Rg", "Cn", "Nh", "Fl", "Mc", "Lv", "Ts", "Og"};

struct Radius {
  std::string_view symbol;
  double angstrom;
};

constexpr double unlisted_radius = 2.0;
constexpr std::array<Radius, 38> bondi{{
    {"H", 1.20},  {"He", 1.40}, {"Li", 1.82}, {"C", 1.70},  {"N", 1.55},  {"O", 1.52},
    {"F", 1.47},  {"Ne", 1.54}, {"Na", 2.27}, {"Mg", 1.73}, {"Si", 2.10}, {"P", 1.80},
    {"S", 1.80},  {"Cl", 1.75}, {"Ar", 1.88}, {"K", 2.75},  {"Ni", 1.63}, {"Cu", 1.40},
    {"Zn", 1.39}, {"Ga", 1.87}, {"As", 1.85}, {"Se", 1.90}, {"Br", 1.85}, {"Kr", 2.02},
    {"Pd", 1.63}, {"Ag", 1.72}, {"Cd", 1.58}, {"In", 1.93}, {"Sn", 2.17}, {"Te", 2.06},
    {"I", 1.98},  {"Xe", 2.16}, {"Pt", 1.72}, {"Au", 1.66}, {"Hg", 1.55}, {"Tl", 1.96},
    {"Pb", 2.02}, {"U", 1.86},
}};

struct Colour {
  std::string_view symbol;
  Rgb rgb;
};

constexpr std::array<Colour, 14> traditional{{
    {"H", {0.95, 0.95, 0.95}},
    {"C", {0.45, 0.45, 0.45}},
    {"N", {0.20, 0.30, 0.95}},
    {"O", {0.90, 0.10, 0.10}},
    {"F", {0.55, 0.85, 0.35}},
    {"Na", {0.55, 0.35, 0.90}},
    {"Mg", {0.30, 0.70, 0.15}},
    {"P", {1.00, 0.55, 0.10}},
    {"S", {0.95, 0.85, 0.20}},
    {"Cl", {0.15, 0.85, 0.15}},
    {"Ca", {0.45, 0.75, 0.45}},
    {"Mn", {0.60, 0.45, 0.75}},
    {"Fe", {0.80, 0.40, 0.15}},
    {"Zn", {0.50, 0.50, 0.70}},
}};

bool is_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

}  // namespace

std::string proper_symbol(std::string_view symbol) {
  std::string proper = lower_case(trimmed(symbol));
  if (!proper.empty() && is_letter(proper.front())) {
    proper.front() = static_cast<char>(proper.front() - 'a' + 'A');
  }
  return proper;
}

std::optional<int> atomic_number(std::string_view symbol) {
  std::string proper = proper_symbol(symbol);
  if (proper == "D" || proper == "T") proper = "H";
  const auto found = std::ranges::find(symbols, proper);
  if (found == symbols.end()) return std::nullopt;
  return static_cast<int>(found - symbols.begin()) + 1;
}

std::optional<std::string_view> symbol_of(int atomic_number) {
  if (atomic_number < 1 || static_cast<std::size_t>(atomic_number) > symbols.size()) {
    return std::nullopt;
  }
  return symbols.at(static_cast<std::size_t>(atomic_number - 1));
}

double van_der_waals_radius(std::string_view symbol) {
  const auto number = atomic_number(symbol);
  if (!number) return unlisted_radius;
  const auto found = std::ranges::find(bondi, *symbol_of(*number), &Radius::symbol);
  return found == bondi.end() ? unlisted_radius : found->angstrom;
}

Rgb element_colour(std::string_view symbol) {
  constexpr double golden_ratio =
      0.6180339887498949;  // gives successive elements very different hues
  const int number = atomic_number(symbol).value_or(0);
  if (const auto proper = symbol_of(number)) {
    const auto found = std::ranges::find(traditional, *proper, &Colour::symbol);
    if (found != traditional.end()) return found->rgb;
  }
  const double turns = golden_ratio * number;
  return hue_colour(turns - std::floor(turns));
}

}  // namespace triptych::scene
