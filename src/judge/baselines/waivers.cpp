#include "judge/baselines/waivers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "core/json_file.hpp"
#include "core/json_text.hpp"
#include "judge/baselines/waiver_values.hpp"

namespace triptych::judge {
namespace {

constexpr std::array<std::pair<ExpectedOutcome, std::string_view>, 3> outcome_names{
    {{ExpectedOutcome::fail, "fail"},
     {ExpectedOutcome::flake, "flake"},
     {ExpectedOutcome::skip, "skip"}}};

Waiver read_waiver(const core::JsonNode& entry) {
  refuse_unknown_keys(entry, {"device", "test", "configuration", "reason", "expiry", "outcome"});
  Waiver waiver{.device = entry.at("device").text(),
                .test = entry.at("test").text(),
                .reason = reason_of(entry),
                .expiry = entry.has("expiry") ? expiry_of(entry) : std::string()};
  if (entry.has("configuration")) waiver.configuration = entry.at("configuration").text();
  return waiver;
}

// Rejects an entry that excuses everything, because it would also hide all later failures.
void refuse_unlimited(const core::JsonNode& entry, const Waiver& waiver) {
  if (matches_every_device(waiver.device) && matches_every_test(waiver.test) &&
      matches_every_configuration(waiver.configuration)) {
    entry.at("test").fail(
        "this entry excuses every finding on every device; name a device, a test or a "
        "configuration");
  }
}

ExpectedOutcome read_outcome(const core::JsonNode& node) {
  const std::string text = node.text();
  const auto found = std::ranges::find(outcome_names, std::string_view(text),
                                       &std::pair<ExpectedOutcome, std::string_view>::second);
  if (found == outcome_names.end()) node.fail("expected fail, flake or skip");
  return found->first;
}

}  // namespace

std::string_view name_of(ExpectedOutcome outcome) {
  return std::ranges::find(outcome_names, outcome,
                           &std::pair<ExpectedOutcome, std::string_view>::first)
      ->second;
}

std::vector<Waiver> read_waivers(const std::filesystem::path& file, const std::string& today) {
  std::vector<Waiver> result;
  const auto json = core::JsonFile::read(file);
  if (!json) return result;
  for (const core::JsonNode& entry : json->root().elements()) {
    // The entry must expire within a year, because an entry that nobody reviews would also hide new
    // failures.
    refuse_distant_expiry(entry.at("expiry"), today);
    result.push_back(read_waiver(entry));
    refuse_unlimited(entry, result.back());
  }
  return result;
}

std::vector<Waiver> read_expected_outcomes(const std::filesystem::path& file) {
  const auto json = core::JsonFile::read(file);
  if (!json) throw core::InputError(file.string() + ": the file does not exist");
  std::vector<Waiver> result;
  for (const core::JsonNode& entry : json->root().elements()) {
    result.push_back(read_waiver(entry));
    static_cast<void>(entry.at("configuration"));
    refuse_unlimited(entry, result.back());
    result.back().outcome = read_outcome(entry.at("outcome"));
  }
  return result;
}

std::string expected_outcomes_text(std::vector<Waiver> waivers) {
  const auto key = [](const Waiver& each) {
    return std::tie(each.device, each.test, each.configuration, each.outcome);
  };
  std::ranges::sort(waivers, {}, key);
  core::Json list = core::Json::array();
  for (const Waiver& each : waivers) {
    core::Json entry{{"device", each.device},
                     {"test", each.test},
                     {"configuration", each.configuration},
                     {"outcome", name_of(each.outcome)},
                     {"reason", core::repaired_utf8(each.reason)}};
    if (!each.expiry.empty()) entry["expiry"] = each.expiry;
    list.push_back(std::move(entry));
  }
  return core::to_lines(list, 1);
}

}  // namespace triptych::judge
