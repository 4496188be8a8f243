#include "report/screen/pixel_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/image.hpp"
#include "core/nan_pixel.hpp"

namespace triptych::report {
namespace {

using accuracy::AllowedRange;
using accuracy::Operation;
using accuracy::SampleRow;

std::string colour_line(std::string_view name, const PixelColour& colour,
                        const std::string& about) {
  return fmt::format("{:<11}{:>14.8f}{:>14.8f}{:>14.8f}{:>14.8f}{}", name, colour[0], colour[1],
                     colour[2], colour[3], about.empty() ? "" : "  " + about);
}

std::string interval(const AllowedRange& allowed) {
  return fmt::format("{:.7g} to {:.7g}", allowed.lo, allowed.hi);
}

// States that a number computed on the device lies outside the interval that the reference allows.
std::string outside(std::string_view what, double number, const AllowedRange& allowed) {
  return fmt::format("{} is {:.7g}, but the reference allows {}", what, number, interval(allowed));
}

std::string about_vector(std::string_view what, const std::array<double, 3>& numbers,
                         const std::array<AllowedRange, 3>& allowed, std::string_view components) {
  std::string text;
  for (std::size_t k = 0; k < 3; ++k) {
    if (numbers[k] >= allowed[k].lo && numbers[k] <= allowed[k].hi) continue;
    text += fmt::format("{}{}", text.empty() ? "" : ", ",
                        outside(fmt::format("{} {}", what, components[k]), numbers[k], allowed[k]));
  }
  return text;
}

std::string about_order(const SampleRow& row) {
  if (!row.taken) {
    return fmt::format("the device did not take this sample, whose opacity is {:.7g}",
                       row.expected->opacity.value);
  }
  return row.expected ? "the device took this sample out of order"
                      : "the device took a sample that does not exist on this ray";
}

// Returns the sentence that follows a row of the table in which the device and the reference
// differ. It states the difference.
std::string difference(const SampleRow& row) {
  const Operation what = row.differs.value();
  if (what == Operation::sampling) return about_order(row);
  const accuracy::ExpectedSample& expected = row.expected.value();
  const accuracy::TakenSample& taken = row.taken.value();
  const std::string_view name = accuracy::name_of(what);
  switch (what) {
    case Operation::position:
      return about_vector(name, taken.position, expected.position, "xyz");
    case Operation::front:
      return outside(name, taken.front, expected.front.value());
    case Operation::value:
      return outside(name, taken.value, expected.value);
    case Operation::alpha:
      return outside(name, taken.alpha, expected.alpha.value());
    case Operation::colour:
      return about_vector("colour", taken.colour, expected.colour, "rgb");
    case Operation::length:
      return outside(name, taken.length, expected.length);
    case Operation::opacity:
      return outside(name, taken.opacity, expected.opacity);
    case Operation::compositing:
    case Operation::sampling:
      break;
  }
  return "compositing: the transmittance and light recorded after this sample are not the result "
         "of compositing the sample with the values recorded before it";
}

std::string numbers(std::string_view name, const std::array<double, 3>& place, double value,
                    const std::array<double, 3>& colour, double length, double opacity) {
  return fmt::format(
      "{:<10}{:>10.4f}{:>10.4f}{:>10.4f}{:>12.7f}{:>10.6f}{:>10.6f}{:>10.6f}"
      "{:>9.4f}{:>12.8f}",
      name, place[0], place[1], place[2], value, colour[0], colour[1], colour[2], length, opacity);
}

std::string device_line(const SampleRow& row) {
  const accuracy::TakenSample& taken = *row.taken;
  return fmt::format("{:>7} {}{:>12.8f}", row.index,
                     numbers(row.compared ? "device" : "merged", taken.position, taken.value,
                             taken.colour, taken.length, taken.opacity),
                     taken.transmittance);
}

std::string reference_line(const SampleRow& row) {
  const accuracy::ExpectedSample& expected = *row.expected;
  const auto values = [](const std::array<AllowedRange, 3>& of) {
    return std::array<double, 3>{of[0].value, of[1].value, of[2].value};
  };
  return fmt::format(
      "{:>7} {}", row.taken ? std::string() : std::to_string(row.index),
      numbers("reference", values(expected.position), expected.value.value, values(expected.colour),
              expected.length.value, expected.opacity.value));
}

// Returns whether the row is merged with its neighbours into one line. This is done if the device
// and the reference agree, and the device either left the sample out or found it to be transparent.
bool can_be_merged(const SampleRow& row) {
  return !row.differs && (!row.taken || row.taken->opacity == 0);
}

std::string merged_line(std::int64_t first, std::int64_t last, std::size_t taken,
                        std::size_t count) {
  const std::string which =
      first == last ? std::to_string(first) : fmt::format("{}–{}", first, last);
  return fmt::format(
      "{:>7} {}", which,
      taken == count ? "transparent"
      : taken == 0   ? "not taken by the device, which does not affect the image"
                     : fmt::format("transparent; the device evaluated only {} of these {} samples",
                                   taken, count));
}

// Returns the end of the sequence of quiet rows (see can_be_merged()) that begins at `begin`.
std::size_t end_of_merged(const std::vector<SampleRow>& rows, std::size_t begin) {
  std::size_t end = begin;
  while (end < rows.size() && can_be_merged(rows[end])) ++end;
  return end;
}

void add_rows(const accuracy::RayHistory& history, PixelText& text) {
  const std::vector<SampleRow>& rows = history.rows;
  for (std::size_t at = 0; at < rows.size();) {
    if (const std::size_t end = end_of_merged(rows, at); end > at) {
      const auto taken = std::count_if(rows.begin() + static_cast<std::ptrdiff_t>(at),
                                       rows.begin() + static_cast<std::ptrdiff_t>(end),
                                       [](const SampleRow& row) { return row.taken.has_value(); });
      text.table.push_back(merged_line(rows[at].index, rows[end - 1].index,
                                       static_cast<std::size_t>(taken), end - at));
      at = end;
      continue;
    }
    const SampleRow& row = rows[at];
    if (row.taken) text.table.push_back(device_line(row));
    if (history.first == at) text.marked = text.table.size() - (row.taken ? 1 : 0);
    if (row.differs && row.expected) text.table.push_back(reference_line(row));
    if (row.differs) {
      text.table.push_back(
          fmt::format("{:>7} {}{}", history.first == at ? "=====>" : "",
                      history.first == at ? "first difference: " : "also: ", difference(row)));
    }
    ++at;
  }
}

// Returns the largest error of all channels, or NaN if a channel is NaN.
double error_of(const PixelInImage& pixel) {
  double error = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const double distance =
        std::abs(static_cast<double>(pixel.image[k]) - static_cast<double>(pixel.reference[k]));
    error = distance <= error ? error : distance;  // NaN counts as large
  }
  return error;
}

std::string about_image(const PixelInImage& pixel) {
  if (core::is_nan_pixel(pixel.image)) {
    return "the pixel was probably not drawn, because it is NaN in all channels, as before the "
           "frame";
  }
  const double error = error_of(pixel);
  return error <= pixel.bound
             ? fmt::format("error {:.3g}, within the bound of {:.3g}", error, pixel.bound)
             : fmt::format("error {:.3g}, beyond the bound of {:.3g}", error, pixel.bound);
}

std::string about_recorded(const PixelInImage& pixel) {
  if (core::is_nan_pixel(*pixel.recorded)) {
    return core::is_nan_pixel(pixel.image)
               ? "the device code that records samples did not draw the pixel, either, so the "
                 "fault is probably in the dispatch and not in the compiled code"
               : "the device code that records samples did not draw the pixel";
  }
  return *pixel.recorded == pixel.image
             ? "the device code that records samples computes the same colour"
             : "the device code that records samples computes a different colour";
}

// Returns lines with the colours of the pixel in the device's image, in the frame that was drawn to
// record the samples, and in the reference image.
std::vector<std::string> colours_of(const PixelInImage& pixel) {
  std::vector<std::string> lines{
      fmt::format("{:<11}{:>14}{:>14}{:>14}{:>14}", fmt::format("{},{}", pixel.x, pixel.y), "red",
                  "green", "blue", "opacity"),
      colour_line("image", pixel.image, about_image(pixel))};
  if (pixel.recorded) {
    lines.push_back(colour_line("recorded", *pixel.recorded, about_recorded(pixel)));
  }
  lines.push_back(colour_line("reference", pixel.reference, ""));
  return lines;
}

std::vector<std::string> summary_of(const PixelInImage& pixel,
                                    const accuracy::RayHistory& history) {
  std::vector<std::string> lines = colours_of(pixel);
  if (pixel.lost > 0) {
    lines.push_back(fmt::format("{} samples at the end of the ray were not recorded", pixel.lost));
  }
  const auto differing = std::ranges::count_if(
      history.rows, [](const SampleRow& row) { return row.differs.has_value(); });
  if (history.rows.empty() && core::is_nan_pixel(pixel.image)) return lines;
  if (!history.first) {
    lines.emplace_back(history.rows.empty() ? "the ray misses the volume"
                                            : "every number is within the interval that the "
                                              "reference allows");
    return lines;
  }
  const SampleRow& first = history.rows[*history.first];
  lines.push_back(fmt::format("{} of {} samples differ; the first is sample {}: {}", differing,
                              history.rows.size(), first.index, difference(first)));
  return lines;
}

// Returns the id of a particle, or "none".
std::string particle_name(std::uint32_t id) {
  return id == core::Image::no_particle ? "none" : std::to_string(id);
}

std::string surface(std::string_view side, std::uint32_t id, double depth,
                    const std::array<double, 4>& colour, std::string_view about) {
  const bool none = id == core::Image::no_particle;
  return fmt::format("{:<10}{:>12}{:>16}{:>10.6f}{:>10.6f}{:>10.6f}  {}", side, particle_name(id),
                     none ? "" : fmt::format("{:.8g}", depth), colour[0], colour[1], colour[2],
                     about);
}

void add_sprite(const accuracy::SpriteHistory& history, std::size_t at, PixelText& text) {
  const accuracy::SpriteRow& row = history.rows[at];
  const accuracy::ExpectedSurface& expected = row.expected;
  const bool differs = row.differs != accuracy::SurfaceDifference::none;
  const bool first = history.first == at;
  text.table.push_back(fmt::format(
      "{:>8} {}", row.id,
      surface("reference", expected.id, expected.depth, expected.colour,
              expected.certain ? fmt::format("depth tolerance {:.3g}, colour tolerance {:.3g}",
                                             expected.depth_bound, expected.colour_bound)
                               : "at the sphere's edge, so the device may or may not show it")));
  if (first) text.marked = text.table.size();
  text.table.push_back(
      fmt::format("{:>8} {}", first ? "======>" : "",
                  surface("device", row.shown.id, row.shown.depth, row.shown.colour,
                          differs ? fmt::format("{}{}", first ? "first difference: " : "also: ",
                                                accuracy::name_of(row.differs))
                                  : "")));
}

// Describes the smallest set of particles that was found for which the pixel is wrong if only these
// particles are drawn.
std::string about_fewest(const accuracy::SpriteHistory& history) {
  constexpr std::size_t max_named = 16;
  const std::size_t count = history.smallest_set.size();
  std::string ids;
  for (std::size_t k = 0; k < std::min(count, max_named); ++k) {
    ids += fmt::format("{}{}", k == 0 ? "" : ", ", history.smallest_set[k]);
  }
  if (count > max_named) ids += ", …";
  return fmt::format(
      "each sphere is correct when drawn alone, but the pixel is wrong ({}) when these {} spheres "
      "are drawn together{}: {}",
      accuracy::name_of(history.smallest_set_differs), count,
      history.stopped_early ? " (and perhaps when fewer are drawn)"
                            : " (but correct if even one of these spheres is left out)",
      ids);
}

}  // namespace

bool is_within_bound(const PixelInImage& pixel) {
  return error_of(pixel) <= pixel.bound;
}

PixelText pixel_text(const PixelInImage& pixel, const accuracy::RayHistory& history) {
  PixelText text;
  text.summary = summary_of(pixel, history);
  text.table.push_back(
      fmt::format("{:>7} {:<10}{:>10}{:>10}{:>10}{:>12}{:>10}{:>10}{:>10}{:>9}"
                  "{:>12}{:>14}",
                  "sample", "", "x", "y", "z", "value", "red", "green", "blue", "length", "opacity",
                  "transmittance"));
  add_rows(history, text);
  return text;
}

PixelText pixel_text(const PixelInImage& pixel, const accuracy::SpriteHistory& history) {
  PixelText text;
  text.summary = colours_of(pixel);
  if (history.first) {
    const accuracy::SpriteRow& row = history.rows[*history.first];
    text.summary.push_back(fmt::format("first difference: particle {}, drawn alone: {}", row.id,
                                       accuracy::name_of(row.differs)));
  } else if (!history.smallest_set.empty()) {
    text.summary.push_back(about_fewest(history));
  } else {
    text.summary.emplace_back(history.rows.empty() ? "the ray hits no sphere"
                                                   : "no sphere differs from the reference");
  }
  if (history.untested > 0) {
    text.summary.push_back(
        fmt::format("{} more spheres behind these were not tested", history.untested));
  }
  text.table.push_back(fmt::format("{:>8} {:<10}{:>12}{:>16}{:>10}{:>10}{:>10}", "sphere", "",
                                   "visible id", "depth", "red", "green", "blue"));
  for (std::size_t at = 0; at < history.rows.size(); ++at) add_sprite(history, at, text);
  return text;
}

std::vector<std::string> part_of_table(const PixelText& text, std::size_t most) {
  if (text.table.size() <= most) return text.table;
  const std::size_t before = std::min(text.marked, most / 3);
  const std::size_t begin = std::max<std::size_t>(text.marked - before, 1);
  const std::size_t end = std::min(begin + most, text.table.size());
  std::vector<std::string> lines{text.table.front()};
  if (begin > 1) lines.push_back(fmt::format("        … {} lines before", begin - 1));
  lines.insert(lines.end(), text.table.begin() + static_cast<std::ptrdiff_t>(begin),
               text.table.begin() + static_cast<std::ptrdiff_t>(end));
  if (end < text.table.size()) {
    lines.push_back(fmt::format("        … {} lines after", text.table.size() - end));
  }
  return lines;
}

}  // namespace triptych::report
