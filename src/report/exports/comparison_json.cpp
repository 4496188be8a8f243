#include "report/exports/comparison_json.hpp"

#include <cmath>
#include <utility>

#include "report/exports/verdict_json.hpp"
#include "report/words/comparison.hpp"
#include "report/words/history.hpp"

namespace triptych::report {
namespace {

using comparison::ComparedConfiguration;
using comparison::Difference;
using core::Json;

template <typename T>
Json all_of(const std::vector<T>& items) {
  Json json = Json::array();
  for (const T& each : items) json.push_back(report::to_json(each));
  return json;
}

Json to_json(const judge::CodeComparison& comparison) {
  Json changes = Json::array();
  for (const judge::CodeChange& each : comparison.changes) {
    changes.push_back({{"executable", each.executable},
                       {"statistic", each.driver_name},
                       {"before", each.before},
                       {"now", each.now}});
  }
  return {
      {"changes", std::move(changes)}, {"gone", comparison.removed}, {"added", comparison.added}};
}

Json to_json(const judge::CodeTotal& total) {
  Json json{{"before", total.before}, {"now", total.now},       {"less", total.less},
            {"more", total.more},     {"helped", total.helped}, {"hurt", total.hurt}};
  if (!total.worst.empty()) json["worst"] = total.worst;
  return json;
}

// Sets `ratio`, `ratio_low` and `ratio_high` to the exponentials of finite values.
void set_ratios(const comparison::Shift& shift, Json& json) {
  const auto set = [&json](const char* name, double ln) {
    if (std::isfinite(ln)) json[name] = std::exp(ln);
  };
  set("ratio", shift.estimate);
  set("ratio_low", shift.interval.low);
  set("ratio_high", shift.interval.high);
}

Json to_json(const comparison::OverallTime& time) {
  Json json{
      {"configurations", time.averaged}, {"decided", time.decided}, {"undecided", time.undecided}};
  set_ratios(time.shift, json);
  return json;
}

Json to_json(const ComparedConfiguration& compared, bool timed, const ComparisonCommand& command) {
  Json json{{"configuration", compared.key}};
  if (!compared.reason.empty()) json["reason"] = report::to_json(compared.reason);
  if (timed) {
    json["verdict"] = compared.verdict_name();
    json["blocks"] = compared.blocks;
    json["seconds"] = compared.seconds;
  }
  if (compared.blocks > 0) {
    json["clock"] = compared.clock == measure::SideClock::device ? "device" : "wall";
    json["frames_per_batch"] = compared.frames_per_batch;
    if (compared.wall_clock_cause != comparison::WallClockCause::none) {
      json["why_wall"] = comparison::name_of(compared.wall_clock_cause);
    }
    if (compared.process_runs > 0) json["process_runs"] = compared.process_runs;
  }
  if (compared.has_time()) {
    if (compared.times) {
      const auto side = [](const comparison::SideTime& time) {
        return Json{{"median_ns", time.median},
                    {"lower_quartile_ns", time.lower_quartile},
                    {"upper_quartile_ns", time.upper_quartile}};
      };
      json["a"] = side((*compared.times)[0]);
      json["b"] = side((*compared.times)[1]);
    }
    set_ratios(compared.shift, json);
    if (compared.verdict == comparison::PairVerdict::undecided && compared.out_of_budget) {
      json["settle"] = command_for(compared, command);
    }
  }
  if (compared.work) {
    json["work"] = {{"counter", compared.work->unit}, {"ln_work", compared.work->log_ratio}};
    if (compared.has_time()) {
      json["work"]["ln_time_per_work"] = compared.shift.estimate - compared.work->log_ratio;
    }
  }
  json["differences"] = all_of(compared.differences);
  return json;
}

}  // namespace

Json to_json(const Difference& difference) {
  Json json{{"kind", comparison::name_of(difference.kind)},
            {"about", difference.about()},
            {"cause", comparison::name_of(difference.cause)},
            {"text", words::text_of(difference)}};
  if (difference.ratio) json["ratio"] = *difference.ratio;
  if (difference.side) json["side"] = measure::name_of(*difference.side);
  if (!difference.numbers.empty()) json["numbers"] = difference.numbers;
  if (!difference.facts.empty()) json["facts"] = difference.facts;
  if (!difference.changes.empty()) json["changes"] = changes_json(difference.changes);
  if (difference.sides[0]) json["a"] = observation_json(*difference.sides[0]);
  if (difference.sides[1]) json["b"] = observation_json(*difference.sides[1]);
  if (difference.worths[0] && difference.worths[1]) {
    json["worths"] = {{"a", *difference.worths[0]}, {"b", *difference.worths[1]}};
  }
  if (difference.code) json["code"] = to_json(*difference.code);
  if (difference.total) json["total"] = to_json(*difference.total);
  if (!difference.injected.empty()) json["injected"] = difference.injected;
  return json;
}

Json to_json(const comparison::DifferenceGroup& group) {
  Json json = to_json(group.difference);
  json["configurations"] = group.count;
  if (!group.where.empty()) json["configuration"] = group.where;
  if (group.ratios) {
    json["ratio_low"] = group.ratios->first;
    json["ratio_high"] = group.ratios->second;
  }
  return json;
}

Json to_json(const comparison::TimeReason& reason) {
  using comparison::TimeCause;
  Json json{{"cause", comparison::name_of(reason.cause)}, {"text", words::text_of(reason)}};
  if (!reason.numbers.empty()) json["numbers"] = reason.numbers;
  switch (reason.cause) {
    case TimeCause::side_ended:
      json["outcome"] = record::name_of(reason.outcome);
      json["reason"] = reason.reason;
      [[fallthrough]];
    case TimeCause::only_one_side:
    case TimeCause::wrong_image:
      json["side"] = measure::name_of(reason.side);
      break;
    case TimeCause::no_fresh_process_runs:
    case TimeCause::not_confirmed:
      json["suspected"] = comparison::name_of(reason.suspected);
      break;
    case TimeCause::none:
    case TimeCause::undecided:
    case TimeCause::budget_ended:
      break;
  }
  return json;
}

Json to_json(const comparison::ComparisonResult& result, const ComparisonCommand& command) {
  Json json{{"plan", command.plan},
            {"sides", command.sides},
            {"a", result.a},
            {"b", result.b},
            {"seconds", result.seconds},
            {"exit_code", static_cast<int>(result.exit_code())},
            {"headline", words::headline(result)},
            {"differences", all_of(result.device)},
            {"configurations", Json::array()}};
  if (const auto overall = result.overall_time()) json["overall"] = to_json(*overall);
  if (result.other_load) json["other_load"] = *result.other_load;
  if (!result.ineffective_variables.empty()) {
    json["ineffective_variables"] = result.ineffective_variables;
  }
  for (const ComparedConfiguration& compared : result.configurations) {
    json["configurations"].push_back(to_json(compared, result.timed, command));
  }
  return json;
}

Json to_json(const comparison::StoreDiff& diff) {
  Json json{{"exit_code", static_cast<int>(diff.exit_code())},
            {"only_one", Json::array()},
            {"devices", Json::array()}};
  for (const comparison::OneSidedEntry& each : diff.one_sided) {
    Json only{
        {"plan", each.plan}, {"side", measure::name_of(each.side)}, {"text", words::text_of(each)}};
    if (!each.device.empty()) only["device"] = each.device;
    json["only_one"].push_back(std::move(only));
  }
  for (const comparison::DeviceChange& change : diff.devices) {
    Json configurations = Json::array();
    for (const comparison::ConfigurationDiff& each : change.configurations) {
      if (each.differences.empty()) continue;
      configurations.push_back(
          {{"configuration", each.key}, {"differences", all_of(each.differences)}});
    }
    json["devices"].push_back({{"a", change.a},
                               {"b", change.b},
                               {"differences", all_of(change.device)},
                               {"configurations", std::move(configurations)}});
  }
  return json;
}

Json to_json(const std::vector<comparison::DeviceHistory>& history) {
  const auto names = names_of(history);
  Json json = Json::array();
  for (const comparison::DeviceHistory& device : history) {
    Json points = Json::array();
    for (const comparison::HistoryPoint& point : device.points) {
      Json each{{"store", point.store},
                {"name", names.at(point.store)},
                {"started_at", point.started_at},
                {"driver_version", point.driver_version},
                {"triptych", point.triptych},
                {"changes", words::lines_of(point.changes)},
                {"differences", all_of(point.changes)},
                {"worse", point.worse}};
      if (point.cost) each["cost"] = *point.cost;
      if (point.time) each["time"] = *point.time;
      if (point.time_change) {
        each["time_change"] = {{"ratio", point.time_change->ratio},
                               {"half_width", point.time_change->half_width},
                               {"noise", point.time_change->is_noise()},
                               {"text", words::text_of(point.time_change)}};
      }
      if (std::string text = words::changed_clocks(point); !text.empty()) {
        each["changed_clocks"] = std::move(text);
      }
      if (!point.injected.empty()) each["injected"] = point.injected;
      points.push_back(std::move(each));
    }
    Json entry{{"device", device.device}, {"points", std::move(points)}};
    if (const comparison::HistoryPoint* worse = device.first_worse()) {
      entry["first_worse"] = worse->store;
    }
    json.push_back(std::move(entry));
  }
  return json;
}

Json to_json(const comparison::SideBySide& table) {
  Json json{{"unit", table.unit}, {"sentence", words::sentence(table)}};
  if (table.is_time()) {
    json["clock"] = table.clock;
    json["process_runs"] = table.process_runs;
  }
  for (const auto& row : table.rows) {
    Json cells = Json::object();
    for (const auto& [device, cell] : row.cells) {
      Json& entry = cells[device];
      entry = {{"value", cell.value}, {"ratio", cell.ratio}, {"work", cell.work}};
      if (!table.is_time() || device == row.best) continue;
      entry["significant"] = cell.is_significant();
      if (!cell.interval) continue;
      entry["ratio_low"] = std::exp(cell.interval->low);
      entry["ratio_high"] = std::exp(cell.interval->high);
    }
    json["rows"].push_back({{"technique", row.technique},
                            {"configurations", row.configurations},
                            {"best", row.best},
                            {"devices", cells}});
  }
  return json;
}

}  // namespace triptych::report
