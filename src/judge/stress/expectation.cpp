#include "judge/stress/expectation.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/error.hpp"
#include "core/image_io.hpp"
#include "record/factor_list.hpp"

namespace triptych::judge {
namespace {

// The position of a pixel.
struct Place {
  int x;
  int y;
};

std::size_t index_of(const core::Image& image, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
         static_cast<std::size_t>(x);
}

bool same_bits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

// An image and its error bound. The bound is used by comparisons that do not require bit-identical
// images.
struct BoundedImage {
  const core::Image& image;
  core::Image bound = {};
};

void add_pixel(Observation& observation, const std::string& prefix,
               const std::array<float, 4>& pixel) {
  constexpr std::array<const char*, 4> channels{"red", "green", "blue", "alpha"};
  for (std::size_t i = 0; i < 4; ++i) {
    set_number(observation, prefix + channels[i], static_cast<double>(pixel[i]));
  }
}

// Compares two images pixel by pixel. Requires that is_inside() returns true for the images.
class SameImageComparison {
 public:
  SameImageComparison(const record::SameImage& rule, const BoundedImage& own,
                      const BoundedImage& other)
      : rule_(rule), own_(own), other_(other) {}

  // Returns nullopt if the images are equal according to the rule.
  [[nodiscard]] std::optional<Observation> difference() const {
    std::size_t differing = 0;
    Place first{-1, -1};
    for (int y = 0; y < own_.image.height; ++y) {
      for (int x = 0; x < own_.image.width; ++x) {
        if (pixels_match(x, y)) continue;
        if (differing++ == 0) first = {x, y};
      }
    }
    if (differing == 0) return std::nullopt;
    Observation observation{.cause = Cause::pixels_differ,
                            .numbers = {{"pixels_differing", static_cast<double>(differing)},
                                        {"pixels", static_cast<double>(own_.image.pixel_count())},
                                        {"x", first.x},
                                        {"y", first.y}},
                            .facts = {{"by", rule_.bit_identical ? "bits" : "bounds"}}};
    const Place other = other_place(first.x, first.y);
    add_pixel(observation, "", own_.image.pixel(first.x, first.y));
    add_pixel(observation, "other_", other_.image.pixel(other.x, other.y));
    return observation;
  }

 private:
  [[nodiscard]] Place other_place(int x, int y) const {
    return {rule_.at[0] + (rule_.mirrored_x ? own_.image.width - 1 - x : x),
            rule_.at[1] + (rule_.mirrored_y ? own_.image.height - 1 - y : y)};
  }

  [[nodiscard]] bool pixels_match(int x, int y) const {
    const Place other = other_place(x, y);
    const std::size_t a = index_of(own_.image, x, y);
    const std::size_t b = index_of(other_.image, other.x, other.y);
    for (std::size_t channel = 0; channel < 4; ++channel) {
      if (!values_match(own_.image.rgba, own_.bound.rgba, 4 * a + channel, other_.image.rgba,
                        other_.bound.rgba, 4 * b + channel)) {
        return false;
      }
    }
    // Ids and depths are compared only where both ids are certain, that is, where their bounds are
    // 0. Elsewhere, round-off may make another surface visible.
    const bool certain = rule_.bit_identical || own_.bound.ids.empty() ||
                         (own_.bound.ids[a] == 0 && other_.bound.ids[b] == 0);
    if (own_.image.ids.empty() || !certain) return true;
    if (rule_.compare_ids && own_.image.ids[a] != other_.image.ids[b]) return false;
    return values_match(own_.image.depth, own_.bound.depth, a, other_.image.depth,
                        other_.bound.depth, b, rule_.depth_scale);
  }

  [[nodiscard]] bool values_match(const std::vector<float>& values,
                                  const std::vector<float>& bounds, std::size_t a,
                                  const std::vector<float>& other_values,
                                  const std::vector<float>& other_bounds, std::size_t b,
                                  float scale = 1) const {
    const float expected = scale * other_values[b];
    if (rule_.bit_identical || same_bits(values[a], expected))
      return same_bits(values[a], expected);
    return std::abs(static_cast<double>(values[a]) - static_cast<double>(expected)) <=
           static_cast<double>(bounds[a]) + static_cast<double>(scale * other_bounds[b]);
  }

  const record::SameImage& rule_;
  const BoundedImage& own_;
  const BoundedImage& other_;
};

bool is_inside(const record::SameImage& rule, const core::Image& image, const core::Image& other) {
  return rule.at[0] >= 0 && rule.at[1] >= 0 && rule.at[0] + image.width <= other.width &&
         rule.at[1] + image.height <= other.height && image.ids.empty() == other.ids.empty();
}

std::optional<Observation> violation_of_rule(const record::SameImage& rule,
                                             const record::Record& record, StressRun& run,
                                             const FindTruth& truth) {
  const std::string levels = record::factor_list(rule.changed);
  const record::Record* other = run.other_record(record, rule.changed);
  const core::Image* other_image = other == nullptr ? nullptr : run.image(*other);
  if (other_image == nullptr) {
    return Observation{.cause = Cause::no_other_image, .facts = {{"levels", levels}}};
  }
  const core::Image& image = *run.image(record);
  if (!is_inside(rule, image, *other_image)) {
    return Observation{.cause = Cause::not_inside,
                       .numbers = {{"width", image.width},
                                   {"height", image.height},
                                   {"x", rule.at[0]},
                                   {"y", rule.at[1]},
                                   {"other_width", other_image->width},
                                   {"other_height", other_image->height}},
                       .facts = {{"levels", levels}}};
  }
  BoundedImage own{image};
  BoundedImage bounded_other{*other_image};
  if (!rule.bit_identical) {
    own.bound = truth(record).bound;
    bounded_other.bound = truth(*other).bound;
  }
  std::optional<Observation> observation =
      SameImageComparison(rule, own, bounded_other).difference();
  if (observation) observation->facts["levels"] = levels;
  return observation;
}

std::optional<Observation> violation_of_rule(const record::UniformColour& rule,
                                             const record::Record& record, StressRun& run,
                                             const FindTruth& /*truth*/) {
  const core::Image& image = *run.image(record);
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    if (same_bits(image.rgba[i], rule.rgba[i % 4])) continue;
    const std::size_t pixel = i / 4;
    const auto width = static_cast<std::size_t>(image.width);
    Observation observation{.cause = Cause::other_colour};
    set_number(observation, "x", static_cast<double>(pixel % width));
    set_number(observation, "y", static_cast<double>(pixel / width));
    set_number(observation, "channel", static_cast<double>(i % 4));
    set_number(observation, "value", static_cast<double>(image.rgba[i]));
    set_number(observation, "expected_value", static_cast<double>(rule.rgba[i % 4]));
    return observation;
  }
  return std::nullopt;
}

std::optional<Observation> violation_of_rule(const record::CountAtMost& rule,
                                             const record::Record& record, StressRun& run,
                                             const FindTruth& /*truth*/) {
  const auto count = record.counters.find(rule.counter);
  if (count == record.counters.end()) {
    return Observation{.cause = Cause::not_counted, .facts = {{"counter", rule.counter}}};
  }
  Observation observation{.cause = Cause::count_too_large,
                          .numbers = {{"count", static_cast<double>(count->second)},
                                      {"factor", rule.factor},
                                      {"unit", 1}},
                          .facts = {{"counter", rule.counter},
                                    {"of", rule.of},
                                    {"levels", record::factor_list(rule.changed)}}};
  if (!rule.of.empty()) {
    const record::Record* other =
        rule.changed.empty() ? &record : run.other_record(record, rule.changed);
    const auto unit =
        other == nullptr ? record::Counts::const_iterator{} : other->counters.find(rule.of);
    if (other == nullptr || unit == other->counters.end()) {
      return Observation{
          .cause = Cause::not_counted,
          .facts = {{"counter", rule.of}, {"levels", record::factor_list(rule.changed)}}};
    }
    observation.numbers["unit"] = static_cast<double>(unit->second);
  }
  if (observation.number("count") <= rule.factor * observation.number("unit")) return std::nullopt;
  return observation;
}

std::optional<Observation> violation_of_rule(const record::MayBeRefused& /*rule*/,
                                             const record::Record& /*record*/, StressRun& /*run*/,
                                             const FindTruth& /*truth*/) {
  return std::nullopt;
}

}  // namespace

StressRun::StressRun(const record::Store& store, const std::vector<record::Record>& records)
    : store_(store) {
  for (const record::Record& record : records) {
    index_.emplace(std::pair(record.device, record::parse_factor_list(record.configuration)),
                   &record);
  }
}

const record::Record* StressRun::other_record(const record::Record& record,
                                              const record::Changed& changed) const {
  Factors factors = record::parse_factor_list(record.configuration);
  for (const auto& [factor, value] : changed) factors[factor] = value;
  const auto found = index_.find({record.device, factors});
  return found == index_.end() ? nullptr : found->second;
}

const core::Image* StressRun::image(const record::Record& record) {
  if (record.image.empty()) return nullptr;
  const auto known = images_.find(record.image);
  if (known != images_.end()) return &known->second;
  try {
    return &images_.emplace(record.image, store_.decoded_image(record.image)).first->second;
  } catch (const core::Error&) {
    return nullptr;
  }
}

bool has_other_record(const record::Expectation& expectation, const record::Record& record,
                      const StressRun& run) {
  const record::Changed* changed = nullptr;
  if (const auto* same = std::get_if<record::SameImage>(&expectation.rule)) {
    changed = &same->changed;
  } else if (const auto* count = std::get_if<record::CountAtMost>(&expectation.rule)) {
    changed = &count->changed;
  }
  return changed == nullptr || changed->empty() || run.other_record(record, *changed) != nullptr;
}

std::optional<Observation> violation_of(const record::Expectation& expectation,
                                        const record::Record& record, StressRun& run,
                                        const FindTruth& truth) {
  std::optional<Observation> observation =
      std::visit([&](const auto& rule) { return violation_of_rule(rule, record, run, truth); },
                 expectation.rule);
  if (observation) {
    observation->against = Against::expectation;
    observation->detail = expectation.what;
  }
  return observation;
}

}  // namespace triptych::judge
