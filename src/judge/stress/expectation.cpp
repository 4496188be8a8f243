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
struct Judged {
  const core::Image& image;
  core::Image bound = {};
};

void add_pixel(Observation& what, const std::string& prefix, const std::array<float, 4>& pixel) {
  constexpr std::array<const char*, 4> channels{"red", "green", "blue", "alpha"};
  for (std::size_t i = 0; i < 4; ++i) {
    set_number(what, prefix + channels[i], static_cast<double>(pixel[i]));
  }
}

// Compares two images pixel by pixel. Requires that fits() returns true for the images.
class SameJudge {
 public:
  SameJudge(const record::SameImage& rule, const Judged& one, const Judged& other)
      : rule_(rule), one_(one), other_(other) {}

  // Returns nullopt if the images are equal according to the rule.
  [[nodiscard]] std::optional<Observation> difference() const {
    std::size_t wrong = 0;
    Place first{-1, -1};
    for (int y = 0; y < one_.image.height; ++y) {
      for (int x = 0; x < one_.image.width; ++x) {
        if (same(x, y)) continue;
        if (wrong++ == 0) first = {x, y};
      }
    }
    if (wrong == 0) return std::nullopt;
    Observation what{.cause = Cause::pixels_differ,
                     .numbers = {{"pixels_differing", static_cast<double>(wrong)},
                                 {"pixels", static_cast<double>(one_.image.pixel_count())},
                                 {"x", first.x},
                                 {"y", first.y}},
                     .facts = {{"by", rule_.to_the_bit ? "bits" : "bounds"}}};
    const Place there = place(first.x, first.y);
    add_pixel(what, "", one_.image.pixel(first.x, first.y));
    add_pixel(what, "other_", other_.image.pixel(there.x, there.y));
    return what;
  }

 private:
  [[nodiscard]] Place place(int x, int y) const {
    return {rule_.at[0] + (rule_.mirrored_x ? one_.image.width - 1 - x : x),
            rule_.at[1] + (rule_.mirrored_y ? one_.image.height - 1 - y : y)};
  }

  [[nodiscard]] bool same(int x, int y) const {
    const Place there = place(x, y);
    const std::size_t a = index_of(one_.image, x, y);
    const std::size_t b = index_of(other_.image, there.x, there.y);
    for (std::size_t channel = 0; channel < 4; ++channel) {
      if (!alike(one_.image.rgba, one_.bound.rgba, 4 * a + channel, other_.image.rgba,
                 other_.bound.rgba, 4 * b + channel)) {
        return false;
      }
    }
    // Ids and depths are compared only where both ids are certain, that is, where their bounds are
    // 0. Elsewhere, round-off may make another surface visible.
    const bool certain = rule_.to_the_bit || one_.bound.ids.empty() ||
                         (one_.bound.ids[a] == 0 && other_.bound.ids[b] == 0);
    if (one_.image.ids.empty() || !certain) return true;
    if (rule_.same_ids && one_.image.ids[a] != other_.image.ids[b]) return false;
    return alike(one_.image.depth, one_.bound.depth, a, other_.image.depth, other_.bound.depth, b,
                 rule_.depth_scale);
  }

  [[nodiscard]] bool alike(const std::vector<float>& mine, const std::vector<float>& my_bound,
                           std::size_t a, const std::vector<float>& theirs,
                           const std::vector<float>& their_bound, std::size_t b,
                           float scale = 1) const {
    const float expected = scale * theirs[b];
    if (rule_.to_the_bit || same_bits(mine[a], expected)) return same_bits(mine[a], expected);
    return std::abs(static_cast<double>(mine[a]) - static_cast<double>(expected)) <=
           static_cast<double>(my_bound[a]) + static_cast<double>(scale * their_bound[b]);
  }

  const record::SameImage& rule_;
  const Judged& one_;
  const Judged& other_;
};

bool fits(const record::SameImage& rule, const core::Image& image, const core::Image& other) {
  return rule.at[0] >= 0 && rule.at[1] >= 0 && rule.at[0] + image.width <= other.width &&
         rule.at[1] + image.height <= other.height && image.ids.empty() == other.ids.empty();
}

std::optional<Observation> unmet_rule(const record::SameImage& rule, const record::Record& record,
                                      StressRun& run, const FindTruth& truth) {
  const std::string levels = record::factor_list(rule.changed);
  const record::Record* other = run.other(record, rule.changed);
  const core::Image* theirs = other == nullptr ? nullptr : run.image(*other);
  if (theirs == nullptr) {
    return Observation{.cause = Cause::no_other_image, .facts = {{"levels", levels}}};
  }
  const core::Image& mine = *run.image(record);
  if (!fits(rule, mine, *theirs)) {
    return Observation{.cause = Cause::not_inside,
                       .numbers = {{"width", mine.width},
                                   {"height", mine.height},
                                   {"x", rule.at[0]},
                                   {"y", rule.at[1]},
                                   {"other_width", theirs->width},
                                   {"other_height", theirs->height}},
                       .facts = {{"levels", levels}}};
  }
  Judged one{mine};
  Judged two{*theirs};
  if (!rule.to_the_bit) {
    one.bound = truth(record).bound;
    two.bound = truth(*other).bound;
  }
  std::optional<Observation> what = SameJudge(rule, one, two).difference();
  if (what) what->facts["levels"] = levels;
  return what;
}

std::optional<Observation> unmet_rule(const record::OneColour& rule, const record::Record& record,
                                      StressRun& run, const FindTruth& /*truth*/) {
  const core::Image& image = *run.image(record);
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    if (same_bits(image.rgba[i], rule.rgba[i % 4])) continue;
    const std::size_t pixel = i / 4;
    const auto width = static_cast<std::size_t>(image.width);
    Observation what{.cause = Cause::other_colour};
    set_number(what, "x", static_cast<double>(pixel % width));
    set_number(what, "y", static_cast<double>(pixel / width));
    set_number(what, "channel", static_cast<double>(i % 4));
    set_number(what, "value", static_cast<double>(image.rgba[i]));
    set_number(what, "expected_value", static_cast<double>(rule.rgba[i % 4]));
    return what;
  }
  return std::nullopt;
}

std::optional<Observation> unmet_rule(const record::CountAtMost& rule, const record::Record& record,
                                      StressRun& run, const FindTruth& /*truth*/) {
  const auto count = record.counters.find(rule.counter);
  if (count == record.counters.end()) {
    return Observation{.cause = Cause::not_counted, .facts = {{"counter", rule.counter}}};
  }
  Observation what{.cause = Cause::count_too_large,
                   .numbers = {{"count", static_cast<double>(count->second)},
                               {"factor", rule.factor},
                               {"unit", 1}},
                   .facts = {{"counter", rule.counter},
                             {"of", rule.of},
                             {"levels", record::factor_list(rule.changed)}}};
  if (!rule.of.empty()) {
    const record::Record* other = rule.changed.empty() ? &record : run.other(record, rule.changed);
    const auto unit =
        other == nullptr ? record::Counts::const_iterator{} : other->counters.find(rule.of);
    if (other == nullptr || unit == other->counters.end()) {
      return Observation{
          .cause = Cause::not_counted,
          .facts = {{"counter", rule.of}, {"levels", record::factor_list(rule.changed)}}};
    }
    what.numbers["unit"] = static_cast<double>(unit->second);
  }
  if (what.number("count") <= rule.factor * what.number("unit")) return std::nullopt;
  return what;
}

std::optional<Observation> unmet_rule(const record::MayBeRefused& /*rule*/,
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

const record::Record* StressRun::other(const record::Record& record,
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

bool has_other(const record::Expectation& expectation, const record::Record& record,
               const StressRun& run) {
  const record::Changed* changed = nullptr;
  if (const auto* same = std::get_if<record::SameImage>(&expectation.rule)) {
    changed = &same->changed;
  } else if (const auto* count = std::get_if<record::CountAtMost>(&expectation.rule)) {
    changed = &count->changed;
  }
  return changed == nullptr || changed->empty() || run.other(record, *changed) != nullptr;
}

std::optional<Observation> unmet(const record::Expectation& expectation,
                                 const record::Record& record, StressRun& run,
                                 const FindTruth& truth) {
  std::optional<Observation> what = std::visit(
      [&](const auto& rule) { return unmet_rule(rule, record, run, truth); }, expectation.rule);
  if (what) {
    what->against = Against::expectation;
    what->detail = expectation.what;
  }
  return what;
}

}  // namespace triptych::judge
