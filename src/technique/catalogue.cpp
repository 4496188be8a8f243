#include "technique/catalogue.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/json.hpp"
#include "triptych_technique_embedded.hpp"

namespace triptych::technique {
namespace {

Method method_of(const core::Json& entry) {
  const std::string name = entry.value("method", "rays");
  if (name == "sprites") return Method::sprites;
  return name == "tiles" ? Method::tiles : Method::rays;
}

Vertices vertices_of(const core::Json& entry) {
  const std::string name = entry.value("vertices", "none");
  if (name == "corners") return Vertices::corners;
  return name == "one" ? Vertices::one : Vertices::none;
}

std::vector<Technique> parse(std::string_view text) {
  std::vector<Technique> result;
  // The parsed JSON is stored in a variable, because at() returns references into it.
  const core::Json catalogue = core::Json::parse(text);
  for (const core::Json& entry : catalogue.at("techniques")) {
    result.push_back(
        {.id = entry.at("id"),
         .suite = entry.at("suite"),
         .work = entry.at("work") == "draw" ? Work::draw : Work::compute,
         .method = method_of(entry),
         .vertices = vertices_of(entry),
         .uses_corners = entry.value("asks_corners", false),
         .fetches_by_index = entry.value("fetches_by_index", method_of(entry) != Method::sprites),
         .instanced = entry.value("instanced", false),
         .parts = entry.value("parts", false),
         .draws_image = entry.at("draws_image"),
         .apis = entry.at("apis"),
         .summary = entry.at("summary")});
  }
  return result;
}

}  // namespace

std::string_view name_of(Work work) {
  return work == Work::draw ? "draw" : "compute";
}

const std::vector<Technique>& catalogue() {
  static const std::vector<Technique> techniques = parse(embedded("catalogue.json"));
  return techniques;
}

const Technique& technique(std::string_view id) {
  const auto& all = catalogue();
  const auto found = std::ranges::find(all, id, &Technique::id);
  if (found != all.end()) return *found;
  std::vector<std::string_view> ids;
  for (const Technique& each : all) ids.push_back(each.id);
  throw core::InputError(
      fmt::format("unknown technique '{}'; expected one of {}", id, fmt::join(ids, ", ")));
}

}  // namespace triptych::technique
