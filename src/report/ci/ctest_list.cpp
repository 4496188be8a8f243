#include "report/ci/ctest_list.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "record/one_per_driver.hpp"

namespace triptych::report {
namespace {

struct Test {
  std::string name;
  std::vector<std::string> command;  // arguments for triptych
  std::vector<std::string> labels;
  std::vector<std::string> requires_fixtures = {};
  std::string fixture_setup = {};
  std::string lock = {};
};

// Returns a CMake bracket argument, which CMake does not interpret. The number of equals signs is
// chosen so that the text does not contain the closing bracket.
std::string bracketed(const std::string& text) {
  std::string equals = "=";
  while ((text + "]").find("]" + equals + "]") != std::string::npos) equals += '=';
  // CMake ignores a line break right after the opening bracket, so a leading line break is doubled.
  return fmt::format("[{0}[{1}{2}]{0}]", equals, text.starts_with('\n') ? "\n" : "", text);
}

std::string quoted(const std::vector<std::string>& words, std::string_view separator) {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += separator;
    text += bracketed(word);
  }
  return text;
}

std::string as_cmake(const Test& test, const std::string& program) {
  const auto list = [](const std::vector<std::string>& words) {
    return bracketed(fmt::format("{}", fmt::join(words, ";")));
  };
  std::string text = fmt::format("add_test({} {} {})\n", bracketed(test.name), bracketed(program),
                                 quoted(test.command, " "));
  text += fmt::format(
      "set_tests_properties({} PROPERTIES\n  LABELS {} SKIP_RETURN_CODE 77 TIMEOUT 1800",
      bracketed(test.name), list(test.labels));
  if (!test.requires_fixtures.empty()) {
    text += "\n  FIXTURES_REQUIRED " + list(test.requires_fixtures);
  }
  if (!test.fixture_setup.empty()) text += "\n  FIXTURES_SETUP " + bracketed(test.fixture_setup);
  if (!test.lock.empty()) text += "\n  RESOURCE_LOCK " + bracketed(test.lock);
  return text + ")\n";
}

bool needs_all(record::Check check) {
  return check == record::Check::stress || check == record::Check::correlation;
}

std::vector<Test> tests_of(const PlanTests& plan, std::span<const record::Device> all) {
  const auto& [suite, argument, stem, store, checks, one_per_driver] = plan;
  const std::vector<record::Device> devices =
      one_per_driver ? record::one_per_driver(all)
                     : std::vector<record::Device>(all.begin(), all.end());
  if (devices.empty()) return {};
  std::vector<Test> tests{{.name = stem + ".start",
                           .command = {"test-start", "--store", store},
                           .labels = {suite, "device"},
                           .fixture_setup = stem}};
  std::vector<std::string> measured;
  for (const record::Device& device : devices) measured.push_back(stem + "." + device.id);
  for (const record::Device& device : devices) {
    const std::string fixture = stem + "." + device.id;
    tests.push_back({.name = stem + ".measure." + device.id,
                     .command = {"test-measure", argument, "--device", device.id, "--store", store},
                     .labels = {suite, "measure", "device", device.api, device.id},
                     .requires_fixtures = {stem},
                     .fixture_setup = fixture,
                     .lock = device.id});
    for (const record::Check each : checks) {
      const std::string check(record::name_of(each));
      tests.push_back(
          {.name = fmt::format("{}.{}.{}", stem, check, device.id),
           .command = {"test-check", argument, "--check", check, "--device", device.id, "--store",
                       store},
           .labels = {suite, check, "device", device.api, device.id},
           // The checks `stress` and `correlation` compare each device with the other devices, so
           // all devices must have been measured.
           .requires_fixtures = needs_all(each) ? measured : std::vector<std::string>{fixture}});
    }
  }
  if (checks.contains(record::Check::image)) {
    tests.push_back({.name = stem + ".agreement",
                     .command = {"test-check", argument, "--check", "image", "--store", store},
                     .labels = {suite, "image", "agreement", "device"},
                     .requires_fixtures = measured});
  }
  return tests;
}

}  // namespace

std::string ctest_stem(std::string_view suite, std::string_view plan) {
  std::string stem = fmt::format("{}.{}", suite, plan.substr(plan.find('/') + 1));
  const auto is_kept = [](char c) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    return letter || c == '.' || c == '-' || c == '_';
  };
  std::ranges::replace_if(stem, std::not_fn(is_kept), '_');
  return stem;
}

std::string ctest_list(const std::string& program, std::span<const PlanTests> plans,
                       std::span<const record::Device> devices) {
  std::string text = "# Generated by triptych for the devices of this machine.\n";
  for (const PlanTests& plan : plans) {
    for (const Test& test : tests_of(plan, devices)) text += as_cmake(test, program);
  }
  return text;
}

}  // namespace triptych::report
