#include "judge/evaluation/evaluation.hpp"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>

namespace triptych::judge {
namespace {

void add(Rate& sum, const Rate& rate) {
  sum.hits += rate.hits;
  sum.trials += rate.trials;
}

using Chosen = std::function<bool(const TrialKind&)>;

Aim aim(std::string text, const Tallies& tallies, Rate Tally::*member, double bound, bool at_least,
        const Chosen& chosen) {
  Aim result{std::move(text), {}, bound, at_least};
  for (const auto& [kind, tally] : tallies) {
    if (chosen(kind)) add(result.rate, tally.*member);
  }
  return result;
}

// What is planted as 3 % is an extra row in 33: sizes are compared with some room.
bool is_size(const TrialKind& kind, double percent) {
  return std::abs(kind.percent - percent) < 0.05 * percent;
}

std::vector<Aim> aims_of(const std::string& method, const Tallies& tallies, bool confirmed) {
  const auto of = [=](Spread spread, double percent = 0) {
    return [=](const TrialKind& kind) {
      return kind.method == method && kind.confirmed == confirmed && kind.spread == spread &&
             (percent == 0 || is_size(kind, percent));
    };
  };
  const std::string name = method + (confirmed ? ", confirmed: " : ": ");
  // In turns it is known what was planted really cost.
  const bool in_turns = method == "compare";
  std::vector<Aim> result{aim(name + (in_turns ? "a configuration that is slower by 3 % found"
                                               : "3 % of one configuration found"),
                              tallies, in_turns ? &Tally::to_be_caught : &Tally::detected, 0.95,
                              true, of(Spread::configuration, 3)),
                          aim(name + "A/A runs with a false alarm", tallies, &Tally::false_alarms,
                              0.01, false, of(Spread::none))};
  if (method == "history") {
    result.push_back(aim(name + "10 % of everything found", tallies, &Tally::detected, 0.9, true,
                         of(Spread::global, 10)));
    result.push_back(aim(name + "a device slower by 10 % taken for the program", tallies,
                         &Tally::false_alarms, 0.1, false, of(Spread::device, 10)));
  }
  if (confirmed) return result;
  result.push_back(aim(name + "configurations of A/A runs that it cannot tell", tallies,
                       &Tally::undecided, 0.05, false, of(Spread::none)));
  return result;
}

std::vector<Aim> aims_of_correlation(const Tallies& tallies, bool confirmed) {
  const auto judges = [=, judging = judging_pairs(tallies)](const TrialKind& kind) {
    return kind.confirmed == confirmed && judging.contains({kind.method, kind.plan, kind.subject});
  };
  const auto is_own = [=](const TrialKind& kind) {
    return judges(kind) && kind.method != by_the_nearest;
  };
  const auto of = [=](Spread spread) {
    return [=](const TrialKind& kind) { return is_own(kind) && kind.spread == spread; };
  };
  const auto of_ten_percent = [=](Spread spread) {
    return [=](const TrialKind& kind) {
      return is_own(kind) && kind.spread == spread && is_size(kind, 10);
    };
  };
  const auto planted_somewhere = [=](const TrialKind& kind) {
    return is_own(kind) && (kind.spread == Spread::configuration || kind.spread == Spread::level);
  };
  // An accepted device's character is known, a new one's is in all that is said of it.
  const auto on = [](std::string_view which, const Chosen& chosen) {
    return [=](const TrialKind& kind) { return chosen(kind) && kind.method.ends_with(which); };
  };
  // What the gate says where several devices are stored.
  const auto nearest_finds = [=](const TrialKind& kind) {
    return judges(kind) && kind.method == by_the_nearest &&
           (kind.spread == Spread::configuration || kind.spread == Spread::level);
  };
  const std::string name = confirmed ? "correlation, confirmed: " : "correlation: ";
  std::vector<Aim> result{
      aim(name + "a configuration that is slower by 25 % found", tallies, &Tally::to_be_caught, 1,
          true, of(Spread::configuration)),
      aim(name + "a factor level that is slower by 5 % found", tallies, &Tally::to_be_caught, 1,
          true, of(Spread::level)),
      aim(name + "false among the discoveries, accepted device", tallies, &Tally::false_discoveries,
          0.05, false, on("accepted device", planted_somewhere)),
      aim(name + "false among the discoveries, new device", tallies, &Tally::false_discoveries,
          0.05, false, on("new device", planted_somewhere)),
      aim(name + "false among the discoveries, new device by the nearest of all others", tallies,
          &Tally::false_discoveries, 0.05, false, nearest_finds),
      aim(name + "10 % of everything found, accepted device", tallies, &Tally::detected, 0.9, true,
          on("accepted device", of_ten_percent(Spread::global))),
      aim(name + "10 % of everything found, new device", tallies, &Tally::detected, 0.9, true,
          on("new device", of_ten_percent(Spread::global))),
      aim(name + "a device slower by 10 % taken for the program", tallies, &Tally::false_alarms,
          0.1, false, of_ten_percent(Spread::device)),
      aim(name + "named first is what was planted", tallies, &Tally::first_named, 0.9, true,
          planted_somewhere),
      aim(name + "work and throughput told apart", tallies, &Tally::split, 0.95, true,
          planted_somewhere),
  };
  if (confirmed) return result;
  result.push_back(aim(name + "uncorrelated pairs refused", tallies, &Tally::detected, 1, true,
                       [](const TrialKind& kind) {
                         return kind.spread == Spread::scrambled && kind.method != by_the_nearest;
                       }));
  return result;
}

}  // namespace

Interval clopper_pearson(std::size_t hits, std::size_t trials, double confidence) {
  if (trials == 0) return {0, 1};
  const double tail = (1 - confidence) / 2;
  const auto k = static_cast<double>(hits);
  const auto n = static_cast<double>(trials);
  return {hits == 0 ? 0 : boost::math::ibeta_inv(k, n - k + 1, tail),
          hits == trials ? 1 : boost::math::ibetac_inv(k + 1, n - k, tail)};
}

double Rate::share() const {
  return trials == 0 ? std::numeric_limits<double>::quiet_NaN()
                     : static_cast<double>(hits) / static_cast<double>(trials);
}

std::string_view name_of(Spread spread) {
  switch (spread) {
    case Spread::none:
      return "none (A/A)";
    case Spread::configuration:
      return "one configuration";
    case Spread::level:
      return "one factor level";
    case Spread::api:
      return "one API";
    case Spread::global:
      return "everything";
    case Spread::device:
      return "the device";
    case Spread::scrambled:
      break;
  }
  return "scrambled";
}

std::optional<double> must_be_caught(Spread spread) {
  if (spread == Spread::configuration) return std::log(1.25);
  if (spread == Spread::level) return std::log(1.05);
  return std::nullopt;
}

SmallestFound smallest_found(const Tallies& tallies, double share) {
  SmallestFound result;
  // Sizes of one kind stand in ascending order: walked from the largest down to the first miss.
  std::map<TrialKind, bool> missed;
  for (auto each = tallies.rbegin(); each != tallies.rend(); ++each) {
    TrialKind kind = each->first;
    const double percent = std::exchange(kind.percent, 0);
    if (percent == 0 || kind.spread == Spread::device) continue;
    bool& already = missed[kind];
    already = already || !(each->second.detected.share() >= share);
    std::optional<double>& smallest = result[kind];
    if (!already) smallest = percent;
  }
  return result;
}

std::set<JudgingPair> judging_pairs(const Tallies& tallies) {
  std::set<JudgingPair> pairs;
  for (const auto& [kind, tally] : tallies) {
    const bool unplanted = kind.method.starts_with("correlation") && !kind.confirmed &&
                           kind.spread == Spread::none && tally.undecided.trials > 0;
    if (unplanted && tally.undecided.share() < 0.5) {
      pairs.insert({kind.method, kind.plan, kind.subject});
    }
  }
  return pairs;
}

std::map<double, Rate> found_by_cost(const Tallies& tallies) {
  std::map<double, Rate> result;
  for (const auto& [kind, tally] : tallies) {
    if (kind.spread != Spread::configuration) continue;
    for (const auto& [percent, rate] : tally.found_by_cost) add(result[percent], rate);
  }
  return result;
}

std::optional<bool> Aim::met() const {
  if (rate.trials == 0) return std::nullopt;
  return at_least ? rate.share() >= bound : rate.share() <= bound;
}

std::vector<Aim> aims(const Tallies& tallies) {
  std::vector<Aim> result = aims_of("compare", tallies, false);
  for (const bool confirmed : {false, true}) {
    std::ranges::move(aims_of("history", tallies, confirmed), std::back_inserter(result));
  }
  for (const bool confirmed : {false, true}) {
    std::ranges::move(aims_of_correlation(tallies, confirmed), std::back_inserter(result));
  }
  result.push_back(aim("gate: the same bytes from the same store", tallies, &Tally::same_bytes, 1,
                       true, [](const TrialKind&) { return true; }));
  return result;
}

std::vector<std::size_t> shuffled(std::size_t count, core::Random& random) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i) {
    const auto other = static_cast<std::size_t>(random.uniform() * static_cast<double>(i));
    std::swap(order[i - 1], order[other]);
  }
  return order;
}

}  // namespace triptych::judge
