#include "scene/header_fields.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace triptych::scene {
namespace {

char opposite(char direction) {
  constexpr std::string_view directions = "RLAPSI";
  const std::size_t at = directions.find(direction);
  return at == std::string_view::npos ? '?' : directions[at ^ 1U];
}

}  // namespace

double dot_product(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double length_of(const Vector3& a) {
  return std::sqrt(dot_product(a, a));
}

std::string sheared_axes(const std::array<Vector3, 3>& axes) {
  constexpr double largest_cosine = 1e-3;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const double lengths = length_of(axes.at(i)) * length_of(axes.at(j));
    if (std::abs(dot_product(axes.at(i), axes.at(j))) > largest_cosine * lengths) {
      return fmt::format("axes {} and {}", i, j);
    }
  }
  return {};
}

std::string anatomical_letters(const std::array<Vector3, 3>& axes, std::string_view positive) {
  std::string letters;
  for (const Vector3& axis : axes) {
    std::size_t largest = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (std::abs(axis.at(i)) > std::abs(axis.at(largest))) largest = i;
    }
    const char towards = positive[largest];
    letters += axis.at(largest) < 0 ? opposite(towards) : towards;
  }
  return letters;
}

}  // namespace triptych::scene
