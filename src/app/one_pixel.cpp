#include "app/one_pixel.hpp"

#include <fmt/format.h>

#include <charconv>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/ray_history.hpp"
#include "app/terminal.hpp"
#include "core/error.hpp"
#include "core/output_files.hpp"
#include "measure/contract/pixel_history.hpp"
#include "report/screen/pixel_history.hpp"

namespace triptych::app {
namespace {

constexpr std::size_t max_table_lines = 60;

int parse_coordinate(std::string_view text, std::string_view whole) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || number < 0) {
    throw core::InputError(fmt::format(
        "--pixel {}: expected X,Y in pixels from the upper left corner of the image", whole));
  }
  return number;
}

accuracy::TakenSample taken_sample(const technique::TracedSample& traced) {
  accuracy::TakenSample taken{.front = traced.front,
                              .value = traced.value,
                              .alpha = traced.colour[3],
                              .length = traced.length,
                              .opacity = traced.opacity,
                              .transmittance = traced.transmittance};
  for (std::size_t k = 0; k < 3; ++k) {
    taken.position[k] = traced.place[k];
    taken.colour[k] = traced.colour[k];
    taken.accumulated[k] = traced.gathered[k];
  }
  return taken;
}

// Merges a part of a step into the preceding parts of the same step. Parts are weighted by their
// contributions to the pixel.
void add_part_of_step(accuracy::TakenSample& step, const accuracy::TakenSample& part) {
  const double added = (1 - step.opacity) * part.opacity;
  const double sum = step.opacity + added;
  for (std::size_t k = 0; k < 3; ++k) {
    step.colour[k] = sum > 0 ? (step.opacity * step.colour[k] + added * part.colour[k]) / sum : 0.0;
  }
  step.opacity = sum;
  step.value = part.value;
  step.transmittance = part.transmittance;
  step.accumulated = part.accumulated;
}

// Converts the recorded samples. The preintegrated quadrature divides a step into parts, and
// records each part with the midpoint of the whole step as its position. Therefore consecutive
// parts with the same position are merged into one sample.
std::vector<accuracy::TakenSample> taken_samples(const technique::RayTrace& trace) {
  std::vector<accuracy::TakenSample> samples;
  for (const technique::TracedSample& traced : trace.samples) {
    const accuracy::TakenSample taken = taken_sample(traced);
    const bool is_same_step = traced.kind == technique::TracedKind::step && !samples.empty() &&
                              samples.back().position == taken.position;
    if (is_same_step) {
      add_part_of_step(samples.back(), taken);
    } else {
      samples.push_back(taken);
    }
  }
  return samples;
}

report::PixelColour colour_at(const core::Image& image, const measure::PixelPlace& place) {
  const std::size_t at =
      4 * (static_cast<std::size_t>(place.y) * static_cast<std::size_t>(image.width) +
           static_cast<std::size_t>(place.x));
  return {image.rgba[at], image.rgba[at + 1], image.rgba[at + 2], image.rgba[at + 3]};
}

}  // namespace

measure::PixelPlace parse_pixel(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return {parse_coordinate("", text), 0};
  return {parse_coordinate(text.substr(0, comma), text),
          parse_coordinate(text.substr(comma + 1), text)};
}

namespace {

struct HistoryText {
  report::PixelText text;
  bool differs = false;
};

HistoryText history_of_volume(measure::SuiteWithTruth& suite, const measure::FrameInProcess& drawn,
                              report::PixelInImage pixel) {
  const measure::TracedPixel& traced = drawn.traced.value();
  auto* const expects = dynamic_cast<measure::RayReference*>(&suite);
  if (expects == nullptr) throw core::NotSupported(measure::pixel_history_of_suite_unsupported);
  const accuracy::ExpectedRay expected = expects->expected_ray(
      drawn.record.factors, drawn.record.precision, traced.place.x, traced.place.y);
  const accuracy::RayHistory history = accuracy::compare(expected, taken_samples(traced.trace));
  pixel.recorded = colour_at(traced.image, traced.place);
  pixel.lost = traced.trace.written - traced.trace.samples.size();
  return {.text = report::pixel_text(pixel, history), .differs = history.first.has_value()};
}

HistoryText history_of_particles(const accuracy::SpriteHistory& history,
                                 const report::PixelInImage& pixel) {
  return {.text = report::pixel_text(pixel, history),
          .differs = history.first.has_value() || !history.smallest_set.empty()};
}

}  // namespace

core::ExitCode print_pixel(measure::SuiteWithTruth& suite, const measure::FrameInProcess& drawn,
                           const accuracy::TruthPair& truth, const std::filesystem::path& out) {
  const measure::TracedPixel& traced = drawn.traced.value();
  const report::PixelInImage pixel{.x = traced.place.x,
                                   .y = traced.place.y,
                                   .image = colour_at(drawn.image, traced.place),
                                   .recorded = {},
                                   .reference = colour_at(truth.truth, traced.place),
                                   .bound = colour_at(truth.bound, traced.place)[0],
                                   .lost = 0};
  const HistoryText shown = traced.sprites ? history_of_particles(*traced.sprites, pixel)
                                           : history_of_volume(suite, drawn, pixel);
  std::string whole;
  for (const auto* lines : {&shown.text.summary, &shown.text.table}) {
    for (const std::string& line : *lines) whole += line + "\n";
  }
  core::write_text(out / "pixel.txt", whole);
  for (const std::string& line : shown.text.summary) print_lines(line + "\n");
  for (const std::string& line : report::part_of_table(shown.text, max_table_lines)) {
    print_lines(line + "\n");
  }
  print_out("{}\n", (out / "pixel.txt").string());
  return shown.differs || !report::is_within_bound(pixel) ? core::ExitCode::regression
                                                          : core::ExitCode::pass;
}

}  // namespace triptych::app
