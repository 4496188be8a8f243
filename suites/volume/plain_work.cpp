#include "suites/volume/plain_work.hpp"

#include "technique/catalogue.hpp"
#include "technique/volume/bricks.hpp"

namespace triptych::volume_suite {
namespace {

bool no_brick_is_empty(const scene::VolumeScene& scene, technique::Skip skip) {
  return !technique::any_brick_is_empty(scene, technique::brick_layout(scene, skip));
}

}  // namespace

measure::PlainWork plain_work(const measure::Configuration& configuration,
                              const measure::VolumeWork& work) {
  measure::PlainWork plain{.levels = configuration};
  plain.levels.erase("ert");
  const technique::Technique& technique = technique::technique(configuration.at("technique"));
  if (technique.draws_image) {
    plain.ends_below = work.options.ert;
  } else if (work.options.ert > 0) {
    plain.why["ert"] = technique.id + " never ends rays early";
  }
  const bool cells = work.scene.quadrature == scene::Quadrature::cells;
  // With quadrature=cells, skip=distance is never equivalent to skip=none, because a ray visits and
  // counts bricks even if none of them is empty.
  if (!cells && work.options.skip == technique::Skip::distance &&
      no_brick_is_empty(work.scene, work.options.skip)) {
    plain.levels["skip"] = technique::name_of(technique::Skip::none);
    plain.why["skip"] = "no brick of this scene is empty";
  }
  if (cells && work.scene.step_voxels > 1) {
    plain.levels["step"] = "1";
    plain.why["step"] = "a step longer than a cell does not subdivide any cell";
  }
  return plain;
}

}  // namespace triptych::volume_suite
