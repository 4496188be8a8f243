#include "judge/baselines/waivers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "core/json_file.hpp"
#include "core/json_text.hpp"

namespace triptych::judge {
namespace {

constexpr std::array<std::pair<Known, std::string_view>, 3> known_names{
    {{Known::fail, "fail"}, {Known::flake, "flake"}, {Known::skip, "skip"}}};

// A day that there is.
bool is_iso_date(std::string_view text) {
  constexpr std::string_view shape = "dddd-dd-dd";
  const bool written_so = std::ranges::equal(
      text, shape, [](char c, char s) { return s == 'd' ? c >= '0' && c <= '9' : c == s; });
  if (!written_so) return false;
  const auto number = [&](std::size_t begin, std::size_t length) {
    return std::stoi(std::string(text.substr(begin, length)));
  };
  const std::chrono::year_month_day date{std::chrono::year(number(0, 4)),
                                         std::chrono::month(static_cast<unsigned>(number(5, 2))),
                                         std::chrono::day(static_cast<unsigned>(number(8, 2)))};
  return date.ok();
}

// A key that nobody reads would leave an entry that excuses more than it says.
void refuse_other_keys(const core::JsonNode& entry) {
  constexpr std::array<std::string_view, 6> known{"device", "test",   "configuration",
                                                  "reason", "expiry", "outcome"};
  for (const auto& [key, value] : entry.members()) {
    if (std::ranges::find(known, key) != known.end()) continue;
    value.fail(fmt::format("no such key; there are: {}", fmt::join(known, ", ")));
  }
}

Waiver read_entry(const core::JsonNode& entry) {
  refuse_other_keys(entry);
  Waiver waiver{.device = entry.at("device").text(),
                .test = entry.at("test").text(),
                .reason = entry.at("reason").text(),
                .expiry = entry.has("expiry") ? entry.at("expiry").text() : std::string()};
  if (entry.has("configuration")) waiver.configuration = entry.at("configuration").text();
  if (waiver.reason.find_first_not_of(" \t") == std::string::npos) {
    entry.at("reason").fail("expected a reason");
  }
  if (entry.has("expiry") && !is_iso_date(waiver.expiry)) {
    entry.at("expiry").fail("expected a day of the calendar as YYYY-MM-DD");
  }
  return waiver;
}

Known read_known(const core::JsonNode& node) {
  const std::string text = node.text();
  const auto found = std::ranges::find(known_names, std::string_view(text),
                                       &std::pair<Known, std::string_view>::second);
  if (found == known_names.end()) node.fail("expected fail, flake or skip");
  return found->first;
}

}  // namespace

std::string_view name_of(Known known) {
  return std::ranges::find(known_names, known, &std::pair<Known, std::string_view>::first)->second;
}

std::vector<Waiver> read_waivers(const std::filesystem::path& file) {
  std::vector<Waiver> result;
  const auto json = core::JsonFile::read(file);
  if (!json) return result;
  for (const core::JsonNode& entry : json->root().elements()) {
    static_cast<void>(entry.at("expiry"));  // by hand nothing is excused for ever
    result.push_back(read_entry(entry));
  }
  return result;
}

std::vector<Waiver> read_expected(const std::filesystem::path& file) {
  const auto json = core::JsonFile::read(file);
  if (!json) throw core::InputError(file.string() + ": there is no such file");
  std::vector<Waiver> result;
  for (const core::JsonNode& entry : json->root().elements()) {
    result.push_back(read_entry(entry));
    static_cast<void>(entry.at("configuration"));
    result.back().known = read_known(entry.at("outcome"));
  }
  return result;
}

std::string expected_text(std::vector<Waiver> waivers) {
  const auto key = [](const Waiver& each) {
    return std::tie(each.device, each.test, each.configuration, each.known);
  };
  std::ranges::sort(waivers, {}, key);
  core::Json list = core::Json::array();
  for (const Waiver& each : waivers) {
    core::Json entry{{"device", each.device},
                     {"test", each.test},
                     {"configuration", each.configuration},
                     {"outcome", name_of(each.known)},
                     {"reason", core::mended_utf8(each.reason)}};
    if (!each.expiry.empty()) entry["expiry"] = each.expiry;
    list.push_back(std::move(entry));
  }
  return core::to_lines(list, 1);
}

}  // namespace triptych::judge
