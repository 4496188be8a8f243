#include "report/figures/figure_elements.hpp"

#include <fmt/format.h>


#include "core/text.hpp"
#include "report/html.hpp"

namespace triptych::report {
namespace {

constexpr double letter = 6.3;  // mean width of a letter in 11 px text
constexpr double mark_radius = 3.2;

std::string mark_path(Mark mark, double x, double y) {
  constexpr double r = mark_radius;
  const auto from = [](double at_x, double at_y, const char* rest) {
    return fmt::format("M{:.1f} {:.1f}{}", at_x, at_y, rest);
  };
  switch (mark) {
    case Mark::triangle:
      return from(x, y - 4.2, "l3.8 7h-7.6z");
    case Mark::cross:
      return from(x - 1.3, y - 3.9, "h2.6v2.6h2.6v2.6h-2.6v2.6h-2.6v-2.6h-2.6v-2.6h2.6z");
    case Mark::diamond:
      return from(x, y - 4.5, "l4.5 4.5l-4.5 4.5l-4.5-4.5z");
    case Mark::square:
      return from(x - r, y - r, "h6.4v6.4h-6.4z");
    case Mark::circle:
      break;
  }
  return from(x - r, y, "a3.2 3.2 0 1 0 6.4 0a3.2 3.2 0 1 0 -6.4 0");
}

}  // namespace

double width_of(std::string_view text) {
  return letter * static_cast<double>(core::character_count(text));
}

std::string shortened(std::string_view text, std::size_t max_length) {
  if (core::character_count(text) <= max_length) return std::string(text);
  const auto byte_of = [&](std::size_t character) {
    std::size_t at = 0;
    for (; at < text.size(); ++at) {
      const bool begins = (static_cast<unsigned char>(text[at]) & 0xC0U) != 0x80;
      if (begins && character-- == 0) break;
    }
    return at;
  };
  const std::size_t half = max_length / 2;
  return std::string(text.substr(0, byte_of(half))) + "…" +
         std::string(text.substr(byte_of(core::character_count(text) - half + 1)));
}

Html title_element(std::string_view text) {
  return text.empty() ? Html() : markup("<title>{}</title>", text);
}

Html text_element(double x, double y, std::string_view anchor, std::string_view text,
                  const Html& more) {
  return markup("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>", x, y, anchor,
                more, text);
}

Html mark_element(double x, double y, const Style& style, std::string_view tooltip) {
  return markup("<path class=\"{} {}\" d=\"{}\"{}>{}</path>", style.hollow ? "line" : "fill",
                style.colour, mark_path(style.mark, x, y),
                style.opacity < 1 ? markup(" opacity=\"{:.2f}\"", style.opacity) : Html(),
                title_element(tooltip));
}

Html line_attributes(const Style& style) {
  return markup("class=\"line {}\" stroke-width=\"{:.1f}\"{}{}", style.colour, style.width,
                style.dashed ? markup(" stroke-dasharray=\"4 3\"") : Html(),
                style.opacity < 1 ? markup(" opacity=\"{:.2f}\"", style.opacity) : Html());
}

}  // namespace triptych::report
