#include "measure/plan/plan_yaml.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace triptych::measure {
namespace {

// Converts the 0-based lines and columns of yaml-cpp to 1-based numbers.
core::FilePlace place_of(const std::string& file, const YAML::Mark& mark) {
  if (mark.is_null()) return {.file = file};
  return {.file = file, .line = mark.line + 1, .column = mark.column + 1};
}

[[noreturn]] void refuse(const std::string& file, const YAML::Node& node,
                         const std::string& message) {
  throw core::InputError(place_of(file, node.Mark()), message);
}

// Records where the last document begins, and ignores its content.
class DocumentStarts : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark& mark) override { last_ = mark; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}

  [[nodiscard]] const YAML::Mark& last() const { return last_; }

 private:
  YAML::Mark last_;
};

// Rejects a file with more than one document. Never requests a third document, because of a defect
// in yaml-cpp: if a token at the root cannot begin a document, such as a comma, yaml-cpp does not
// consume the token and reports an empty document again and again. LoadAll() would therefore fill
// the memory.
void refuse_second_document(const std::string& yaml, const std::string& file) {
  std::istringstream stream(yaml);
  YAML::Parser parser(stream);
  DocumentStarts starts;
  if (!parser.HandleNextDocument(starts) || !parser.HandleNextDocument(starts)) return;
  const YAML::Mark& mark = starts.last();
  const auto position = static_cast<std::size_t>(std::max(mark.pos, 0));
  const bool starts_document = position < yaml.size() && yaml.compare(position, 3, "---") == 0;
  throw core::InputError(
      place_of(file, mark),
      starts_document
          ? "a second YAML document begins here, but a plan must be a single document"
          : "not valid YAML: this text follows the end of the plan and cannot begin a new "
            "document");
}

YAML::Node load(std::string_view yaml, const std::string& file) {
  const std::string text(yaml);
  YAML::Node document;
  try {
    refuse_second_document(text, file);
    document = YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw core::InputError(place_of(file, error.mark), "not valid YAML: " + error.msg);
  }
  if (document.IsNull()) {
    throw core::InputError({.file = file}, "the plan is empty; expected 'suite:' and factors");
  }
  if (!document.IsMap()) {
    refuse(file, document, "expected 'factor: values' lines, beginning with 'suite:'");
  }
  return document;
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
    refuse(file, node,
           fmt::format("'{}' is an empty list; remove the entry to use the default", owner));
  }
  std::vector<PlacedText> values;
  for (const YAML::Node& each : node) values.push_back(scalar(each, file, owner));
  return values;
}

record::Checks checks_of(const std::vector<PlacedText>& names) {
  record::Checks checks;
  for (const PlacedText& name : names) {
    try {
      if (!checks.insert(record::check(name.text)).second) {
        throw core::InputError(fmt::format("'{}' is given twice", name.text));
      }
    } catch (const core::InputError& error) {
      throw core::InputError(name.place, fmt::format("'checks': {}", error.what()));
    }
  }
  if (checks.contains(record::Check::cost) && checks.contains(record::Check::timing)) {
    throw core::InputError(names.front().place,
                           "'checks': 'cost' and 'timing' cannot be combined, because instructions "
                           "are counted in an emulator, which distorts times; write two separate "
                           "plans");
  }
  if (checks.contains(record::Check::code) && checks.size() > 1) {
    throw core::InputError(names.front().place,
                           "'checks': 'code' cannot be combined with other checks, because a plan "
                           "with this check compiles code but draws nothing; write two separate "
                           "plans");
  }
  return checks;
}

// Records the places of keys and rejects duplicate keys, because yaml-cpp accepts a mapping in
// which a key occurs twice.
class Keys {
 public:
  void add(const PlacedText& key) {
    const auto [first, added] = seen_.emplace(key.text, key.place);
    if (!added) {
      throw core::InputError(
          key.place, fmt::format("'{}' is given twice; the first entry is on line {}", key.text,
                                 first->second.line));
    }
  }

 private:
  std::map<std::string, core::FilePlace> seen_;
};

PlanEntry entry_of(PlacedText key, const YAML::Node& node, const std::string& file) {
  std::vector<PlacedText> values = values_of(node, file, key.text);
  return {.factor = std::move(key), .values = std::move(values)};
}

std::vector<std::vector<PlanEntry>> also_of(const YAML::Node& node, const std::string& file) {
  if (!node.IsSequence()) refuse(file, node, "'also': expected a list of 'factor: values' blocks");
  std::vector<std::vector<PlanEntry>> blocks;
  for (const YAML::Node& block : node) {
    if (!block.IsMap()) refuse(file, block, "'also': expected 'factor: values' lines");
    Keys keys;
    std::vector<PlanEntry>& entries = blocks.emplace_back();
    for (const auto& pair : block) {
      PlacedText key = scalar(pair.first, file, "a factor's name");
      keys.add(key);
      entries.push_back(entry_of(std::move(key), pair.second, file));
    }
  }
  return blocks;
}

}  // namespace

PlanText parse_plan(std::string_view yaml, const std::string& file) {
  PlanText plan;
  Keys keys;
  for (const auto& pair : load(yaml, file)) {
    PlacedText key = scalar(pair.first, file, "a factor's name");
    keys.add(key);
    if (key.text == "suite") {
      plan.suite = scalar(pair.second, file, key.text);
    } else if (key.text == "summary") {
      plan.summary = scalar(pair.second, file, key.text).text;
    } else if (key.text == "checks") {
      plan.checks = checks_of(values_of(pair.second, file, key.text));
    } else if (key.text == "also") {
      plan.also = also_of(pair.second, file);
    } else {
      plan.entries.push_back(entry_of(std::move(key), pair.second, file));
    }
  }
  if (plan.suite.text.empty()) {
    throw core::InputError(
        {.file = file, .line = 1},
        "'suite:' is missing; add the name of the suite that defines the factors");
  }
  return plan;
}

}  // namespace triptych::measure
