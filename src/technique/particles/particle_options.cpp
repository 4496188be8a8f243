#include "technique/particles/particle_options.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace triptych::technique {

std::string_view name_of(ComputedAt stage) {
  return stage == ComputedAt::vertex ? "vertex" : "pixel";
}

std::string_view name_of(Culling culling) {
  switch (culling) {
    case Culling::none:
      return "none";
    case Culling::frustum:
      return "frustum";
    case Culling::occlusion:
      return "occlusion";
  }
  return {};
}

std::string_view name_of(Structure structure) {
  switch (structure) {
    case Structure::built_once:
      return "static";
    case Structure::refitted:
      return "refit";
    case Structure::rebuilt:
      return "rebuild";
  }
  return {};
}

Structure structure(std::string_view name) {
  for (const Structure each : {Structure::built_once, Structure::refitted, Structure::rebuilt}) {
    if (name == name_of(each)) return each;
  }
  throw core::InputError(
      fmt::format("unknown structure '{}'; expected static, refit or rebuild", name));
}

ComputedAt computed_at(std::string_view name) {
  for (const ComputedAt stage : {ComputedAt::vertex, ComputedAt::pixel}) {
    if (name == name_of(stage)) return stage;
  }
  throw core::InputError(fmt::format("unknown stage '{}'; expected vertex or pixel", name));
}

Culling culling(std::string_view name) {
  for (const Culling each : {Culling::none, Culling::frustum, Culling::occlusion}) {
    if (name == name_of(each)) return each;
  }
  throw core::InputError(
      fmt::format("unknown culling '{}'; expected none, frustum or occlusion", name));
}

}  // namespace triptych::technique
