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

ComputedAt computed_at(std::string_view name) {
  for (const ComputedAt stage : {ComputedAt::vertex, ComputedAt::pixel}) {
    if (name == name_of(stage)) return stage;
  }
  throw core::InputError(fmt::format("unknown stage '{}'; there are: vertex, pixel", name));
}

Culling culling(std::string_view name) {
  for (const Culling each : {Culling::none, Culling::frustum, Culling::occlusion}) {
    if (name == name_of(each)) return each;
  }
  throw core::InputError(
      fmt::format("unknown culling '{}'; there are: none, frustum, occlusion", name));
}

}  // namespace triptych::technique
