// Creates pages from a store in which every string is hostile. Each string must be shown as plain
// text.

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/image_io.hpp"
#include "core/json.hpp"
#include "report/page/history_page.hpp"
#include "report/page/page.hpp"
#include "support/temporary_folder.hpp"
#include "support/well_formed.hpp"
#include "triptych_report_embedded.hpp"

namespace triptych::report {
namespace {

using core::Json;

// All tags that Triptych's pages contain. Any other tag must have come from an unescaped string.
const std::set<std::string>& known_tags() {
  static const std::set<std::string> tags{
      "circle", "dd",     "dl",      "dt",     "a",    "article",    "b",       "body",
      "br",     "button", "details", "dialog", "div",  "figcaption", "figure",  "form",
      "g",      "h1",     "h2",      "h3",     "h4",   "head",       "header",  "html",
      "img",    "input",  "label",   "li",     "link", "main",       "meta",    "ol",
      "option", "output", "p",       "path",   "pre",  "rect",       "section", "select",
      "span",   "style",  "summary", "svg",    "code", "mark",       "table",   "td",
      "text",   "th",     "title",   "tr",     "wbr",  "script"};
  return tags;
}
bool is_known_attribute(const std::string& name) {
  static const std::set<std::string> names{"alt",
                                           "charset",
                                           "class",
                                           "content",
                                           "cx",
                                           "cy",
                                           "d",
                                           "height",
                                           "hidden",
                                           "href",
                                           "http-equiv",
                                           "id",
                                           "lang",
                                           "max",
                                           "method",
                                           "min",
                                           "name",
                                           "opacity",
                                           "placeholder",
                                           "r",
                                           "rel",
                                           "role",
                                           "scope",
                                           "src",
                                           "style",
                                           "tabindex",
                                           "stroke-dasharray",
                                           "stroke-width",
                                           "text-anchor",
                                           "transform",
                                           "type",
                                           "value",
                                           "viewBox",
                                           "width",
                                           "x",
                                           "xmlns",
                                           "y"};
  return names.contains(name) || name.starts_with("data-") || name.starts_with("aria-");
}

// Returns the first element that Triptych does not generate, or an empty string. The page must
// contain Triptych's own script and style sheet exactly once each.
std::string unknown_markup_in(std::string page) {
  for (const char* file : {"page.js", "style.css"}) {
    const std::string own_text(embedded(file));
    const std::size_t at = page.find(own_text);
    if (at != std::string::npos) page.erase(at, own_text.size());
  }
  std::map<std::string, int> seen;
  for (std::size_t at = page.find('<'); at != std::string::npos; at = page.find('<', at)) {
    const std::size_t end = page.find('>', at);
    const std::string tag = page.substr(at, end - at + 1);
    at = end == std::string::npos ? page.size() : end + 1;
    std::size_t i = 1;
    if (tag.starts_with("<!DOCTYPE") || tag.starts_with("</")) continue;
    while (i < tag.size() && (std::isalnum(static_cast<unsigned char>(tag[i])) != 0)) ++i;
    const std::string name = tag.substr(1, i - 1);
    if (!known_tags().contains(name) || ++seen[name] == 0) return tag;
    while (i < tag.size() && tag[i] != '>') {
      while (i < tag.size() && (tag[i] == ' ' || tag[i] == '\n' || tag[i] == '/')) ++i;
      if (i >= tag.size() || tag[i] == '>') break;
      const std::size_t name_end = tag.find_first_of("= >", i);
      const std::string attribute = tag.substr(i, name_end - i);
      if (!is_known_attribute(attribute)) return attribute + " in " + tag.substr(0, 200);
      i = name_end;
      if (i < tag.size() && tag[i] == '=') {
        if (tag[i + 1] != '"') return "no quote in " + tag.substr(0, 200);
        const std::size_t close = tag.find('"', i + 2);
        if (close == std::string::npos) return "a value with '>' in " + tag.substr(0, 200);
        const std::string value = tag.substr(i + 2, close - i - 2);
        const bool leads_out = attribute == "href" && value != "data:," && !value.starts_with("#");
        const bool loads = attribute == "src" && !value.starts_with("data:image/png;base64,");
        if (leads_out || loads) return tag.substr(0, 200);
        i = close + 1;
      }
    }
  }
  return seen["script"] > 1 || seen["style"] > 1 ? "a second script or style" : "";
}

// Replaces every string value with a hostile string, numbered so that all of them differ.
Json hostile(const Json& json, const std::string& string, int& number) {
  const auto next = [&] { return std::to_string(++number) + string; };
  if (json.is_string()) return next();
  Json result = json;
  if (json.is_array()) {
    for (Json& each : result) each = hostile(each, string, number);
  }
  if (json.is_object()) {
    for (auto& [key, value] : result.items()) value = hostile(value, string, number);
  }
  return result;
}

std::map<std::string, std::string> pairs(const std::string& s) {
  return {{"technique" + s, s}, {s, s}, {"data", s}, {"skip", s}};
}

record::Record record_of(const std::string& s, int number, const std::string& image) {
  const record::Counts counts{{s, 3}, {"samples", 10}, {"samples_nonzero", 5}};
  record::Record record;
  record.run = s;
  record.suite = s;
  record.plan = s;
  record.configuration = s + std::to_string(number);
  record.scene = s;
  record.technique = s;
  record.device = s;
  record.factors = pairs(s);
  record.outcome = image.empty() ? record::Outcome::crashed : record::Outcome::measured;
  record.reason = {.cause = record::Cause::api_error,
                   .subject = s,
                   .code = s,
                   .shared_levels = s,
                   .detail = s,
                   .last_output = s};
  record.injected = s;
  record.counters = counts;
  record.statistics = counts;
  record.memory = counts;
  record.energy = counts;
  record.cost = counts;
  record.prepare_cost = counts;
  record.counted_by = s;
  record.code[s].statistics = {{s, 3}, {"instructions", 4}};
  record.code[s].assembly = s;
  record.kernel_hash = s;
  record.data_hash = s;
  record.image = image;
  record.benchmark_json = s;
  if (!image.empty()) record.wall_ns = {1e6, 2e6, 3e6};
  if (number == 2) record.same_as = s + "1";
  return record;
}

judge::GateResult verdict_of(const std::string& s, const record::Record& record) {
  judge::GateResult result{.plan = s, .run = s, .findings = {}};
  const std::vector<judge::Cause> causes{
      judge::Cause::values_changed, judge::Cause::ended,          judge::Cause::other_data,
      judge::Cause::no_baselines,   judge::Cause::not_stored,     judge::Cause::unused_waiver,
      judge::Cause::other_plan,     judge::Cause::listing_failed, judge::Cause::device_missing,
      judge::Cause::checks_lost,    judge::Cause::error,          judge::Cause::other_counter};
  for (const judge::Verdict verdict :
       {judge::Verdict::regression, judge::Verdict::cannot_judge, judge::Verdict::advisory,
        judge::Verdict::waived, judge::Verdict::skipped, judge::Verdict::pass}) {
    for (const judge::Check check :
         {judge::Check::image, judge::Check::cost, judge::Check::timing, judge::Check::counters}) {
      judge::Finding finding;
      finding.check = check;
      finding.verdict = verdict;
      finding.test = s;
      finding.device = record.device;
      finding.configuration = record.configuration;
      finding.subject = s;
      finding.cause = causes.at(result.findings.size() % causes.size());
      finding.names = {s, s};
      finding.detail = s;
      finding.reason = record.reason;
      finding.changes = {{.name = s, .before = 1, .now = 2}};
      finding.advice = {judge::Advice::accept, s};
      for (const char* fact : {"run", "plan", "glob", "kind", "hash", "now", "accepted", "folder",
                               "test", "device", "expiry", "other", "driver_version", "what",
                               "sibling", "counter", "levels", "configuration", "device_key"}) {
        finding.facts[fact] = s;
      }
      finding.injected = {s};
      finding.accepted_on = {s};
      finding.numbers = {{"ratio", 1.1}, {s, 2}};
      result.findings.push_back(finding);
    }
  }
  result.devices = {record.device};
  result.environments = {{record.device, {{s, s}, {"LP_" + s, s}}}};
  result.argument = s;
  result.defaults = pairs(s);
  result.baselines = s;
  result.unusable = {{s, s, {}}, {s, "", record.reason}};
  result.injected = {{s, 2}};
  result.measured_by = s;
  judge::CorrelationPair pair{.device_a = s, .device_b = s, .signal = s};
  pair.points = {{.configuration = s, .x = 1, .y = 2, .residual = 0.1, .outlier = true},
                 {.configuration = s, .x = 2, .y = 3, .residual = 0.1, .outlier = false}};
  result.correlations = {pair};
  accuracy::AccuracyScene scene;
  scene.device = s;
  scene.limit = s;
  scene.scene = s;
  scene.data = s;
  accuracy::AccuracyCase one;
  one.configuration = s;
  one.factors = {{"step", "1"}, {s, s}};
  one.rmse = 0.1;
  one.time_ns = 1e6;
  scene.cases = {one, one};
  scene.cases[1].rmse = 0.2;
  scene.cases[1].factors["step"] = "2";
  accuracy::AccuracyFamily family;
  family.name = s;
  family.members = {0, 1};
  scene.families = {family};
  scene.front = {0};
  result.accuracies = {scene};
  return result;
}

std::string page_of(const std::string& s) {
  const test::TemporaryFolder folder;
  record::Store store(folder.path() / "s.sqlite", record::Store::Mode::append);
  record::Run run{.id = s, .plan = s, .started_at = s, .system = {{s, s}}};
  run.plan_hash = s;
  store.add_run(run);
  record::Device device;
  device.id = s;
  device.api = device.name = device.vendor = device.driver = s;
  device.driver_version = device.api_version = device.cpu_features = s;
  device.environment = device.limits = {{s, s}};
  device.statistics_calibration[s].counter = s;
  device.statistics_calibration[s].detail = s;
  device.statistics_calibration[s].worth = record::Worth::differs;
  device.faults = {{.subject = s, .detail = s, .last_output = s}};
  record::ClockTrust clock;
  clock.work = clock.verdict = s;
  store.add_device(run.id, device, {clock});
  core::Image image(8, 8);
  const std::vector<std::byte> exr = core::encode_exr(image);
  store.add_image(s, exr);
  for (int i = 1; i <= 2; ++i) store.add_record(record_of(s, i, s));
  store.add_record(record_of(s, 3, {}));
  const auto truth = [](const record::Record&) {
    return judge::TruthPair{core::Image(8, 8), core::Image(8, 8)};
  };
  return page(store, {.plans = {{run, verdict_of(s, store.records(s).front())}}, .truth = truth});
}

const std::vector<std::string>& strings() {
  static const std::vector<std::string> all{"<script>alert(1)</script>",
                                            "\"><script>alert(1)</script>",
                                            "\" onload=\"alert(1)",
                                            "' onload='alert(1)",
                                            "<img src=x onerror=alert(1)>",
                                            "</style><script>alert(1)</script>",
                                            "</title><script>alert(1)</script>",
                                            "</script><script>alert(1)//",
                                            "<!--",
                                            "]]><svg onload=alert(1)>",
                                            "javascript:alert(1)",
                                            "&lt;script&gt;",
                                            "{}{0}%s",
                                            "\x1b[31m\u202Ered\u2066"};
  return all;
}

TEST(HostilePage, EveryStringStaysText) {
  for (const std::string& each : strings()) {
    const std::string drawn = page_of(each);
    EXPECT_EQ(unknown_markup_in(drawn), "") << each;
    EXPECT_THAT(drawn, testing::HasSubstr("</main>")) << each;
    for (const char* hidden : {"\x1b", "\u202E", "\u2066"}) {
      EXPECT_EQ(drawn.find(hidden), std::string::npos) << each;
    }
  }
}

// Shows that the test can fail: it must detect the elements that unescaped names could insert.
TEST(HostilePage, AnInsertedElementIsFound) {
  for (const char* page :
       {"<p><blink>x</blink></p>", "<p onload=\"x\">", "<a href=\"javascript:x\">", "<p class=x>",
        "<img src=\"http://x\">", "<script>1</script><script>2</script>"}) {
    EXPECT_NE(unknown_markup_in(page), "") << page;
  }
}

TEST(HostilePage, EveryStringOfAHistoryStaysText) {
  const Json point{{"name", ""}, {"driver_version", ""}, {"started_at", ""}, {"changes", "x"}};
  for (const std::string& each : strings()) {
    int number = 0;
    Json device =
        hostile({{"device", ""}, {"first_worse", ""}, {"points", Json::array({point, point})}},
                each, number);
    for (Json& at : device["points"]) {
      at["worse"] = true;
      at["injected"] = Json::array({each});
      at["cost"] = 1.0;
    }
    EXPECT_EQ(unknown_markup_in(history_page(Json::array({device}))), "") << each;
  }
}

// Even if an element were inserted, its script would not run, because the policy allows only the
// script with the hash of the page's own script.
TEST(HostilePage, ThePolicyAllowsOnlyThePagesScript) {
  const std::string drawn = page_of("x");
  EXPECT_THAT(drawn, testing::HasSubstr("<meta http-equiv=\"Content-Security-Policy\" content=\""
                                        "default-src 'none'; img-src data:; style-src "
                                        "'unsafe-inline'; script-src 'sha256-"));
  EXPECT_EQ(drawn.find("script-src 'unsafe-inline'"), std::string::npos);
  EXPECT_LT(drawn.find("Content-Security-Policy"), drawn.find("<title>"));
}

}  // namespace
}  // namespace triptych::report
