#include "measure/plan_yaml.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <charconv>
#include <map>

namespace triptych::measure {
namespace {

// yaml-cpp counts from 0.
core::FilePlace place_of(const std::string& file, const YAML::Mark& mark) {
  if (mark.is_null()) return {.file = file};
  return {.file = file, .line = mark.line + 1, .column = mark.column + 1};
}

[[noreturn]] void refuse(const std::string& file, const YAML::Node& node,
                         const std::string& message) {
  throw core::InputError(place_of(file, node.Mark()), message);
}

YAML::Node load(std::string_view yaml, const std::string& file) {
  std::vector<YAML::Node> documents;
  try {
    documents = YAML::LoadAll(std::string(yaml));
  } catch (const YAML::Exception& error) {
    throw core::InputError(place_of(file, error.mark), "not valid YAML: " + error.msg);
  }
  if (documents.empty() || documents.front().IsNull()) {
    throw core::InputError({.file = file}, "the plan is empty; expected 'suite:' and factors");
  }
  if (documents.size() > 1) refuse(file, documents[1], "a second document; a plan is one");
  if (!documents.front().IsMap()) {
    refuse(file, documents.front(), "expected 'factor: values' lines, beginning with 'suite:'");
  }
  return documents.front();
}

PlacedText scalar(const YAML::Node& node, const std::string& file, const std::string& owner) {
  if (node.IsNull()) refuse(file, node, fmt::format("'{}' has no value", owner));
  if (!node.IsScalar()) {
    refuse(file, node,
           fmt::format("'{}': expected a value, found a {}", owner,
                       node.IsMap() ? "mapping" : "list within a list"));
  }
  return {.text = node.Scalar(), .place = place_of(file, node.Mark())};
}

std::vector<PlacedText> values_of(const YAML::Node& node, const std::string& file,
                                  const std::string& owner) {
  if (!node.IsSequence()) return {scalar(node, file, owner)};
  if (node.size() == 0) {
    refuse(file, node, fmt::format("'{}' is an empty list; leave it out for its default", owner));
  }
  std::vector<PlacedText> values;
  for (const YAML::Node& each : node) values.push_back(scalar(each, file, owner));
  return values;
}

bool truth_value(const PlacedText& value) {
  if (value.text == "true") return true;
  if (value.text == "false") return false;
  throw core::InputError(value.place,
                         fmt::format("'timed': expected true or false, found '{}'", value.text));
}

int number_of_rounds(const PlacedText& value) {
  int rounds = 0;
  const char* end = value.text.data() + value.text.size();
  const auto [stop, error] = std::from_chars(value.text.data(), end, rounds);
  if (error == std::errc{} && stop == end && rounds >= 1 && rounds <= 99) return rounds;
  throw core::InputError(
      value.place, fmt::format("'rounds': expected a number from 1 to 99, found '{}'", value.text));
}

}  // namespace

PlanText parse_plan(std::string_view yaml, const std::string& file) {
  PlanText plan;
  std::map<std::string, core::FilePlace> seen;
  // yaml-cpp keeps every pair of a mapping, also those whose key was there before.
  for (const auto& pair : load(yaml, file)) {
    PlacedText key = scalar(pair.first, file, "a factor's name");
    const auto [first, added] = seen.emplace(key.text, key.place);
    if (!added) {
      throw core::InputError(key.place, fmt::format("'{}' is given twice, first in line {}",
                                                    key.text, first->second.line));
    }
    if (key.text == "suite") {
      plan.suite = scalar(pair.second, file, key.text);
    } else if (key.text == "summary") {
      static_cast<void>(scalar(pair.second, file, key.text));
    } else if (key.text == "timed") {
      plan.timed = truth_value(scalar(pair.second, file, key.text));
    } else if (key.text == "rounds") {
      plan.rounds = number_of_rounds(scalar(pair.second, file, key.text));
    } else {
      std::vector<PlacedText> values = values_of(pair.second, file, key.text);
      plan.entries.push_back({.factor = std::move(key), .values = std::move(values)});
    }
  }
  if (plan.suite.text.empty()) {
    throw core::InputError({.file = file, .line = 1}, "no 'suite:' says what the factors are of");
  }
  return plan;
}

}  // namespace triptych::measure
