#include "measure/plan.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "core/error.hpp"
#include "measure/plan_yaml.hpp"

namespace triptych::measure {
namespace {

// More is a slip of the pen: at a tenth of a second each these would take a day.
constexpr std::size_t most_configurations = 1'000'000;

// --- names that are nearly right
// -------------------------------------------------------------------------

// Levenshtein's distance: insertions, deletions and replacements of single characters.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

// "; did you mean 'step'?", or all there are where nothing is near.
std::string suggestion(std::string_view wrong, const std::vector<std::string>& known) {
  const auto distance = [&](const std::string& each) { return edit_distance(wrong, each); };
  const auto nearest = std::ranges::min_element(known, {}, distance);
  if (nearest != known.end() && distance(*nearest) <= std::max<std::size_t>(2, wrong.size() / 3)) {
    return fmt::format("; did you mean '{}'?", *nearest);
  }
  return fmt::format("; there are: {}", fmt::join(known, ", "));
}

// --- values
// ------------------------------------------------------------------------------------------------

// One spelling per number: the shortest that reads back as the same double, so that 0.5, .5 and
// 5e-1 are one value. Empty when the text is not a finite number.
std::optional<double> parse_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  if (!whole || !std::isfinite(number)) return std::nullopt;
  return number == 0 ? 0 : number;  // no −0
}

std::string canonical_number(const Factor& factor, const PlacedText& value) {
  if (std::ranges::find(factor.levels, value.text) != factor.levels.end()) return value.text;
  const std::optional<double> number = parse_number(value.text);
  if (!number) {
    throw core::InputError(
        value.place, fmt::format("'{}': expected a number, found '{}'", factor.name, value.text));
  }
  if (*number < factor.minimum || *number > factor.maximum) {
    throw core::InputError(value.place,
                           fmt::format("'{}': {} is out of range; expected {} to {}", factor.name,
                                       *number, factor.minimum, factor.maximum));
  }
  return fmt::format("{}", *number);
}

std::string canonical_choice(const Factor& factor, const PlacedText& value) {
  if (std::ranges::find(factor.levels, value.text) != factor.levels.end()) return value.text;
  throw core::InputError(value.place,
                         fmt::format("'{}' has no level '{}'{}", factor.name, value.text,
                                     suggestion(value.text, factor.levels)));
}

// Keys of configurations are lists of name=value; a value must not look like two.
std::string canonical_text(const Factor& factor, const PlacedText& value) {
  if (value.text.empty() || value.text.find_first_of(",=\n\r") != std::string::npos) {
    throw core::InputError(value.place, fmt::format("'{}': a value is not empty and has no comma, "
                                                    "'=' or line break; found '{}'",
                                                    factor.name, value.text));
  }
  return value.text;
}

// The default in the same spelling as values from a plan.
std::string standard_of(const Factor& factor) {
  if (factor.kind == FactorKind::number) {
    if (const auto number = parse_number(factor.standard)) return fmt::format("{}", *number);
  }
  return factor.standard;
}

std::string canonical(const Suite& suite, const Factor& factor, const PlacedText& value) {
  // "auto" may be the default of a factor of any kind, and may then be said aloud.
  if (value.text == factor.standard) return standard_of(factor);
  std::string text;
  switch (factor.kind) {
    case FactorKind::number:
      text = canonical_number(factor, value);
      break;
    case FactorKind::choice:
      text = canonical_choice(factor, value);
      break;
    case FactorKind::text:
      text = canonical_text(factor, value);
      break;
  }
  try {
    suite.check(factor, text);
  } catch (const core::InputError& error) {
    throw core::InputError(value.place, fmt::format("'{}': {}", factor.name, error.what()));
  }
  return text;
}

std::vector<std::string> canonical_values(const Suite& suite, const Factor& factor,
                                          const std::vector<PlacedText>& values) {
  std::vector<std::string> result;
  for (const PlacedText& value : values) {
    std::string text = canonical(suite, factor, value);
    const auto same = std::ranges::find(result, text);
    if (same != result.end()) {
      const PlacedText& first = values[static_cast<std::size_t>(same - result.begin())];
      throw core::InputError(
          value.place, fmt::format("'{}': {} is there twice{}", factor.name, value.text,
                                   first.text == value.text ? "" : ", first as " + first.text));
    }
    result.push_back(std::move(text));
  }
  return result;
}

// --- factors
// -----------------------------------------------------------------------------------------------

const Factor& factor_of(const Suite& suite, const PlacedText& name) {
  const auto found = std::ranges::find(suite.factors(), name.text, &Factor::name);
  if (found != suite.factors().end()) return *found;
  std::vector<std::string> known;
  for (const Factor& each : suite.factors()) known.push_back(each.name);
  throw core::InputError(
      name.place, fmt::format("unknown factor '{}'{}", name.text, suggestion(name.text, known)));
}

using ValuesByFactor = std::map<std::string, std::vector<std::string>>;

// Sets, or sets anew, what the entries name.
void set_values(const Suite& suite, const std::vector<PlanEntry>& entries, ValuesByFactor& values) {
  for (const PlanEntry& entry : entries) {
    const Factor& factor = factor_of(suite, entry.factor);
    values[factor.name] = canonical_values(suite, factor, entry.values);
  }
}

void apply(const Overrides& overrides, const Suite& suite, ValuesByFactor& values) {
  std::vector<std::string> seen;
  for (const auto& [name, texts] : overrides) {
    const core::FilePlace place{.file = "--set " + name};
    const Factor& factor = factor_of(suite, {.text = name, .place = place});
    if (std::ranges::find(seen, name) != seen.end()) {
      throw core::InputError(place, "given twice; put all values into one list: a,b");
    }
    seen.push_back(name);
    if (texts.empty()) throw core::InputError(place, "expected factor=value or factor=a,b");
    std::vector<PlacedText> placed;
    for (const std::string& each : texts) placed.push_back({.text = each, .place = place});
    values[name] = canonical_values(suite, factor, placed);
  }
}

// --- combinations
// --------------------------------------------------------------------------------------------

// A factor and its values; those before it vary more slowly.
struct Axis {
  const Factor* factor;
  std::vector<std::string> values;
};

// Loading data costs most, then building a pipeline, then moving the camera.
int speed_of(const Factor& factor) {
  if (factor.name == "data") return 0;
  if (factor.name == "viewport") return 2;
  if (factor.name == "camera") return 3;
  return 1;
}

std::vector<Axis> axes_of(const Suite& suite, const ValuesByFactor& values) {
  std::vector<Axis> axes;
  for (const Factor& factor : suite.factors()) {
    const auto given = values.find(factor.name);
    axes.push_back(
        {&factor, given == values.end() ? std::vector{standard_of(factor)} : given->second});
  }
  std::ranges::stable_sort(axes, {}, [](const Axis& axis) { return speed_of(*axis.factor); });
  return axes;
}

void require_few(const std::vector<Axis>& axes, const std::string& plan) {
  std::size_t count = 1;
  for (const Axis& axis : axes) {
    count *= axis.values.size();
    if (count > most_configurations) {
      throw core::InputError(
          {.file = plan},
          fmt::format("more than {} combinations; split the plan", most_configurations));
    }
  }
}

// As an odometer: the last axis turns at every step.
std::vector<Configuration> combine(const std::vector<Axis>& axes) {
  std::vector<Configuration> configurations;
  std::vector<std::size_t> place(axes.size(), 0);
  for (;;) {
    Configuration& configuration = configurations.emplace_back();
    for (std::size_t i = 0; i < axes.size(); ++i) {
      configuration[axes[i].factor->name] = axes[i].values[place[i]];
    }
    std::size_t turning = axes.size();
    while (turning > 0 && ++place[turning - 1] == axes[turning - 1].values.size()) {
      place[--turning] = 0;
    }
    if (turning == 0) return configurations;
  }
}

// --- where plans come from
// ---------------------------------------------------------------------------------

struct PlanSource {
  std::string name;
  std::string file;   // what errors call it
  std::string suite;  // of a short name; empty for a file
  std::string yaml;
};

PlanSource read_plan_file(const std::filesystem::path& file) {
  std::error_code ignored;
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file, ignored)) {
    throw core::InputError({.file = file.string()},
                           "cannot be read; a plan is a YAML file or a short name SUITE/PLAN");
  }
  return {.name = plan_name(file.string()),
          .file = file.string(),
          .suite = "",
          .yaml = std::string(std::istreambuf_iterator<char>(stream), {})};
}

// Short names have one slash and no ending; "./name" is always a file.
bool is_short_name(std::string_view text) {
  const std::size_t slash = text.find('/');
  return slash != std::string_view::npos && slash > 0 && slash + 1 < text.size() &&
         text.find('/', slash + 1) == std::string_view::npos &&
         text.find('.') == std::string_view::npos;
}

PlanSource find_plan(std::string_view name_or_file, const FindSuite& find_suite) {
  if (!is_short_name(name_or_file)) return read_plan_file(std::filesystem::path(name_or_file));
  const std::size_t slash = name_or_file.find('/');
  const Suite& suite = find_suite(name_or_file.substr(0, slash));
  const std::string_view plan = name_or_file.substr(slash + 1);
  std::vector<std::string> known;
  for (const std::string_view each : suite.plan_names()) known.emplace_back(each);
  if (std::ranges::find(known, plan) == known.end()) {
    throw core::InputError(
        fmt::format("suite '{}' has no plan '{}'{}", suite.name(), plan, suggestion(plan, known)));
  }
  return {.name = std::string(name_or_file),
          .file = std::string(name_or_file),
          .suite = std::string(suite.name()),
          .yaml = std::string(suite.plan_text(plan))};
}

const Suite& suite_of(const PlanSource& source, const PlanText& text, const FindSuite& find_suite) {
  if (!source.suite.empty() && text.suite.text != source.suite) {
    throw core::InputError(text.suite.place, fmt::format("a plan of suite '{}' says 'suite: {}'",
                                                         source.suite, text.suite.text));
  }
  try {
    return find_suite(text.suite.text);
  } catch (const core::InputError& error) {
    throw core::InputError(text.suite.place, error.what());
  }
}

// Adds the combinations that are not there yet, beside others of the same data.
void add(const std::vector<Configuration>& more, std::vector<Configuration>& configurations) {
  const std::set<Configuration> known(configurations.begin(), configurations.end());
  for (const Configuration& each : more) {
    if (!known.contains(each)) configurations.push_back(each);
  }
  std::map<std::string, std::size_t> rank;
  for (const Configuration& each : configurations) rank.emplace(each.at("data"), rank.size());
  std::ranges::stable_sort(configurations, {},
                           [&](const Configuration& each) { return rank.at(each.at("data")); });
}

// Of one set of values or more, each with all its combinations; none is there twice.
Plan make_plan(const std::string& name, const Suite& suite,
               const std::vector<ValuesByFactor>& blocks) {
  Plan plan{.name = name,
            .suite = std::string(suite.name()),
            .configurations = {},
            .varied = {},
            .timed = true,
            .rounds = 1};
  for (const ValuesByFactor& values : blocks) {
    const std::vector<Axis> axes = axes_of(suite, values);
    require_few(axes, name);
    if (plan.configurations.empty()) {
      plan.configurations = combine(axes);
    } else {
      add(combine(axes), plan.configurations);
    }
  }
  for (const Axis& axis : axes_of(suite, blocks.front())) {
    const std::string& factor = axis.factor->name;
    const std::string& first = plan.configurations.front().at(factor);
    const auto differs = [&](const Configuration& each) { return each.at(factor) != first; };
    if (std::ranges::any_of(plan.configurations, differs)) plan.varied.push_back(factor);
  }
  return plan;
}

}  // namespace

std::string plan_name(std::string_view name_or_file) {
  return is_short_name(name_or_file) ? std::string(name_or_file)
                                     : std::filesystem::path(name_or_file).stem().string();
}

Plan load_plan(std::string_view name_or_file, const Overrides& overrides,
               const FindSuite& find_suite) {
  const PlanSource source = find_plan(name_or_file, find_suite);
  const PlanText text = parse_plan(source.yaml, source.file);
  const Suite& suite = suite_of(source, text, find_suite);
  std::vector<ValuesByFactor> blocks(1 + text.also.size());
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    set_values(suite, text.entries, blocks[i]);
    if (i > 0) set_values(suite, text.also[i - 1], blocks[i]);
    apply(overrides, suite, blocks[i]);
  }
  Plan plan = make_plan(source.name, suite, blocks);
  plan.timed = text.timed;
  plan.rounds = text.rounds;
  return plan;
}

Plan default_plan(const Suite& suite, const Overrides& overrides) {
  ValuesByFactor values;
  apply(overrides, suite, values);
  return make_plan(std::string(suite.name()) + "/defaults", suite, {values});
}

std::string configuration_key(const Suite& suite, const Configuration& configuration) {
  std::string key;
  for (const auto& [name, value] : configuration) {  // a map: sorted by name
    const auto factor = std::ranges::find(suite.factors(), name, &Factor::name);
    const bool always = name == "technique" || name == "data" || name == "camera";
    if (!always && factor != suite.factors().end() && standard_of(*factor) == value) continue;
    key += fmt::format("{}{}={}", key.empty() ? "" : ",", name, value);
  }
  return key;
}

void keep_shard(Plan& plan, int index, int count) {
  if (count < 1 || index < 1 || index > count) {
    throw core::InputError(fmt::format("shard {}/{}: expected i/n with 1 ≤ i ≤ n", index, count));
  }
  const auto data_of = [](const Configuration& configuration) {
    const auto data = configuration.find("data");
    return data == configuration.end() ? std::string() : data->second;
  };
  std::vector<std::string> data_sets;
  for (const Configuration& each : plan.configurations) {
    if (data_sets.empty() || data_sets.back() != data_of(each)) data_sets.push_back(data_of(each));
  }
  // Data sets are dealt out whole as long as there is one for every shard; the rest is dealt out by
  // configuration, so that no shard has more than one above another.
  const auto shards = static_cast<std::size_t>(count);
  const auto mine = static_cast<std::size_t>(index - 1);
  const std::size_t whole = data_sets.size() / shards * shards;
  std::vector<Configuration> kept;
  std::size_t data_set = 0;
  std::size_t rest = 0;
  for (Configuration& each : plan.configurations) {
    while (data_sets[data_set] != data_of(each)) ++data_set;
    const std::size_t owner = (data_set < whole ? data_set : rest++) % shards;
    if (owner == mine) kept.push_back(std::move(each));
  }
  plan.configurations = std::move(kept);
}

}  // namespace triptych::measure
