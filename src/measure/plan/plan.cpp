#include "measure/plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "measure/plan/plan_combinations.hpp"
#include "measure/plan/plan_values.hpp"
#include "measure/plan/plan_yaml.hpp"
#include "record/factor_list.hpp"
#include "technique/catalogue.hpp"

namespace triptych::measure {
namespace {

// --- factors

const Factor& factor_of(const Suite& suite, const PlacedText& name) {
  const auto found = std::ranges::find(suite.factors(), name.text, &Factor::name);
  if (found != suite.factors().end()) return *found;
  std::vector<std::string> known;
  for (const Factor& each : suite.factors()) known.push_back(each.name);
  throw core::InputError(
      name.place, fmt::format("unknown factor '{}'{}", name.text, suggestion(name.text, known)));
}

// The factors and values in a block of a plan. The first block consists of the plan's own entries.
// Each mapping under `also` adds a block, in which it replaces some of these entries.
struct BlockText {
  ValuesByFactor values;
  std::set<std::string> automatic;  // factors with "auto" among their values

  void set(const Suite& suite, const Factor& factor, const std::vector<PlacedText>& given) {
    values[factor.name] = canonical_values(suite, factor, given);
    automatic.erase(factor.name);
    if (is_automatic(factor, given)) automatic.insert(factor.name);
  }
};

// Sets the values of the factors in the entries. Existing values are replaced.
void set_values(const Suite& suite, const std::vector<PlanEntry>& entries, BlockText& block) {
  for (const PlanEntry& entry : entries) {
    block.set(suite, factor_of(suite, entry.factor), entry.values);
  }
}

// An override (--set) with its values as typed by the user.
struct PlacedOverride {
  const Factor* factor;
  std::vector<PlacedText> values;
};

std::vector<PlacedOverride> with_places(const Overrides& overrides, const Suite& suite) {
  std::vector<PlacedOverride> all;
  for (const auto& [name, texts] : overrides) {
    const core::FilePlace place{.file = "--set " + name};
    // A separate variable avoids a false warning from GCC 14 about a dangling reference.
    const PlacedText placed_name{.text = name, .place = place};
    const Factor& factor = factor_of(suite, placed_name);
    if (std::ranges::find(all, &factor, &PlacedOverride::factor) != all.end()) {
      throw core::InputError(place,
                             "the factor is set twice; list all its values at once: factor=a,b");
    }
    if (texts.empty()) throw core::InputError(place, "expected factor=value or factor=a,b");
    std::vector<PlacedText> values;
    for (const std::string& each : texts) values.push_back({.text = each, .place = place});
    all.push_back({&factor, std::move(values)});
  }
  return all;
}

// Replaces the values of the overridden factors in the block.
void apply(const std::vector<PlacedOverride>& overrides, const Suite& suite, BlockText& block) {
  for (const PlacedOverride& each : overrides) block.set(suite, *each.factor, each.values);
}

std::vector<std::string> values_in(const BlockText& block, const Factor& factor) {
  const auto found = block.values.find(factor.name);
  return found == block.values.end() ? std::vector{default_of(factor)} : found->second;
}

// Keeps only those of the block's values that are also in `values`. Returns false if no value would
// be left.
bool keep_values(const std::vector<std::string>& values, const Factor& factor, BlockText& block) {
  const std::vector<std::string> known = values_in(block, factor);
  std::vector<std::string> kept;
  for (const std::string& each : values) {
    if (std::ranges::find(known, each) != known.end()) kept.push_back(each);
  }
  if (kept.empty()) return false;
  block.values[factor.name] = std::move(kept);
  block.automatic.erase(factor.name);
  return true;
}

// Applies the overrides to all blocks of a plan, and returns which blocks are used. There are two
// cases:
// - If all values of an override occur in the plan, the override selects configurations. Each block
//   keeps only these values, and a block that has none of them is left out. Replacing the values in
//   each block instead would create combinations that the plan does not contain and for which no
//   baselines are stored.
// - If an override has a value that does not occur in the plan, it replaces the values in every
//   block.
//
// If the selection would leave out every block, all overrides replace values instead.
std::vector<bool> apply_to_all(const std::vector<PlacedOverride>& overrides, const Suite& suite,
                               std::vector<BlockText>& blocks) {
  std::vector<BlockText> chosen = blocks;
  std::vector<bool> used(blocks.size(), true);
  for (const PlacedOverride& each : overrides) {
    const Factor& factor = *each.factor;
    const std::vector<std::string> values = canonical_values(suite, factor, each.values);
    const bool known = std::ranges::all_of(values, [&](const std::string& value) {
      return std::ranges::any_of(blocks, [&](const BlockText& block) {
        const std::vector<std::string> in_block = values_in(block, factor);
        return std::ranges::find(in_block, value) != in_block.end();
      });
    });
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (!known || is_automatic(factor, each.values)) {
        chosen[i].set(suite, factor, each.values);
      } else if (!keep_values(values, factor, chosen[i])) {
        used[i] = false;
      }
    }
  }
  if (std::ranges::find(used, true) != used.end()) {
    blocks = std::move(chosen);
    return used;
  }
  for (BlockText& block : blocks) apply(overrides, suite, block);
  return std::vector<bool>(blocks.size(), true);
}

// --- sources of plans

struct PlanSource {
  std::string name;
  std::string file;   // the name in error messages
  std::string suite;  // the suite in a short name; empty for a file
  std::string yaml;
};

PlanSource read_plan_file(const std::filesystem::path& file) {
  if (file.empty()) {
    throw core::InputError("no plan was given; expected a YAML file or SUITE/PLAN");
  }
  try {
    return {.name = plan_name(file.string()),
            .file = file.string(),
            .suite = "",
            .yaml = core::read_text(file)};
  } catch (const core::IoError& error) {
    throw core::InputError(
        fmt::format("{}; expected a YAML file or a short name SUITE/PLAN", error.what()));
  }
}

// Short names have one slash and no file extension; "./name" is always a file.
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
    throw core::InputError(text.suite.place,
                           fmt::format("the plan belongs to suite '{}', but contains 'suite: {}'",
                                       source.suite, text.suite.text));
  }
  try {
    return find_suite(text.suite.text);
  } catch (const core::InputError& error) {
    throw core::InputError(text.suite.place, error.what());
  }
}

// Returns the place of the longest list of values, which the user should shorten if there are too
// many configurations.
core::FilePlace longest_place(const PlanSource& source, const ValuesByFactor& values,
                              const std::vector<const std::vector<PlanEntry>*>& entries,
                              const Overrides& overrides) {
  const auto size = [](const auto& each) { return each.second.size(); };
  const auto longest = std::ranges::max_element(values, {}, size);
  if (longest == values.end()) return {.file = source.file};
  const auto named = [&](const auto& override) { return override.first == longest->first; };
  if (std::ranges::any_of(overrides, named)) return {.file = "--set " + longest->first};
  core::FilePlace place{.file = source.file};
  for (const std::vector<PlanEntry>* block : entries) {
    for (const PlanEntry& entry : *block) {
      if (entry.factor.text == longest->first) place = entry.factor.place;
    }
  }
  return place;
}

// The limit for a run. More configurations are treated as a mistake, because they would take more
// than a day at a tenth of a second each.
constexpr std::size_t most_configurations = 1'000'000;
// The limit for listing a plan, which keeps the time for listing below a day. It is higher than the
// limit for a run, because listing does not store the configurations.
constexpr std::size_t most_listed = 100'000'000;

// A plan that was read, but whose configurations have not been generated yet.
struct OpenPlan {
  Plan plan;  // without configurations
  const Suite& suite;
  Combinations combinations;
  std::vector<core::FilePlace> places;  // for each block, the place of its longest list of values
};

Plan plan_of(const std::string& name, const Suite& suite, const Combinations& combinations) {
  return {.name = name,
          .suite = std::string(suite.name()),
          .summary = {},
          .configurations = {},
          .varied = combinations.varied(),
          .checks = Plan::default_checks(),
          .hash = {}};
}

OpenPlan open_plan(std::string_view name_or_file, const Overrides& overrides,
                   const FindSuite& find_suite) {
  const PlanSource source = find_plan(name_or_file, find_suite);
  const PlanText text = parse_plan(source.yaml, source.file);
  const Suite& suite = suite_of(source, text, find_suite);
  std::vector<BlockText> texts(1 + text.also.size());
  const auto entries_of = [&](std::size_t block) {
    std::vector<const std::vector<PlanEntry>*> entries{&text.entries};
    if (block > 0) entries.push_back(&text.also[block - 1]);
    return entries;
  };
  for (std::size_t i = 0; i < texts.size(); ++i) {
    for (const auto* each : entries_of(i)) set_values(suite, *each, texts[i]);
  }
  const std::vector<bool> used = apply_to_all(with_places(overrides, suite), suite, texts);
  std::vector<ValuesByFactor> blocks;
  std::vector<core::FilePlace> places;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (!used[i]) continue;
    blocks.push_back(texts[i].values);
    places.push_back(longest_place(source, blocks.back(), entries_of(i), overrides));
  }
  Combinations combinations(suite, blocks);
  Plan plan = plan_of(source.name, suite, combinations);
  plan.summary = text.summary;
  if (!text.checks.empty()) plan.checks = text.checks;
  plan.hash = core::content_hash(source.yaml);
  plan.argument = name_or_file;
  for (const ValuesByFactor& block : blocks) {
    for (const auto& [factor, values] : block) plan.named.insert(factor);
  }
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (used[i]) plan.automatic.insert(texts[i].automatic.begin(), texts[i].automatic.end());
  }
  return {std::move(plan), suite, std::move(combinations), std::move(places)};
}

void require_at_most(const Combinations& combinations, const std::vector<core::FilePlace>& places,
                     const Shard& shard, std::size_t most = most_configurations) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (combinations.upper_bound_of(i) / static_cast<std::size_t>(std::max(1, shard.count)) <=
        most) {
      continue;
    }
    throw core::InputError(
        places[i],
        fmt::format("the plan has more than {} combinations, and this factor has the most values; "
                    "shorten its list, measure the plan in shards (--shard i/n), or split the plan",
                    most));
  }
}

void add_configurations(const Combinations& combinations, const Shard& shard, Plan& plan) {
  combinations.for_each(shard,
                        [&](const Configuration& each) { plan.configurations.push_back(each); });
}

}  // namespace

bool Plan::judges_images() const {
  using enum record::Check;
  return checks.contains(image) || checks.contains(accuracy) || checks.contains(stress);
}

bool Plan::judges_counters() const {
  using enum record::Check;
  return checks.contains(counters) || checks.contains(accuracy);
}

record::Checks Plan::default_checks() {
  using record::Check;
  return {Check::image, Check::counters, Check::statistics, Check::memory, Check::timing};
}

std::string plan_name(std::string_view name_or_file) {
  return is_short_name(name_or_file) ? std::string(name_or_file)
                                     : std::filesystem::path(name_or_file).stem().string();
}

Plan load_plan(std::string_view name_or_file, const Overrides& overrides,
               const FindSuite& find_suite, const Shard& shard) {
  OpenPlan open = open_plan(name_or_file, overrides, find_suite);
  require_at_most(open.combinations, open.places, shard);
  add_configurations(open.combinations, shard, open.plan);
  return std::move(open.plan);
}

Plan list_plan(std::string_view name_or_file, const Overrides& overrides,
               const FindSuite& find_suite, const Shard& shard,
               const std::function<void(const Suite&, const Configuration&)>& use) {
  OpenPlan open = open_plan(name_or_file, overrides, find_suite);
  require_at_most(open.combinations, open.places, shard, most_listed);
  open.combinations.for_each(shard, [&](const Configuration& each) { use(open.suite, each); });
  return std::move(open.plan);
}

Plan default_plan(const Suite& suite, const Overrides& overrides) {
  BlockText block;
  apply(with_places(overrides, suite), suite, block);
  const Combinations combinations(suite, {block.values});
  require_at_most(combinations, {{.file = "--set"}}, {});
  Plan plan = plan_of(std::string(suite.name()) + "/defaults", suite, combinations);
  plan.automatic = block.automatic;
  add_configurations(combinations, {}, plan);
  return plan;
}

std::string configuration_key(const Suite& suite, const Configuration& configuration) {
  Configuration named = configuration;
  std::erase_if(named, [&](const auto& level) {
    const auto& [name, value] = level;
    const auto factor = std::ranges::find(suite.factors(), name, &Factor::name);
    const bool always = name == "technique" || name == "data" || name == "camera";
    return !always && factor != suite.factors().end() && default_of(*factor) == value;
  });
  return record::factor_list(named);
}

std::vector<std::string> work_kinds(const Plan& plan) {
  std::set<std::string> kinds;
  for (const Configuration& each : plan.configurations) {
    kinds.emplace(technique::name_of(technique::technique(each.at("technique")).work));
  }
  return {kinds.begin(), kinds.end()};
}

}  // namespace triptych::measure
