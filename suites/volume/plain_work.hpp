#pragma once
// Finds volume configurations that do exactly the same work (measure::Suite::plain).

#include "measure/contract/suite.hpp"

namespace triptych::volume_suite {

// If no brick is empty, skipping by leaps is the same work as no skipping, because rays detect this
// at once and take every sample. Stepping from brick to brick is additional work even then. Whether
// early termination changes the work is found by comparing images; speed_of_light ignores early
// termination.
[[nodiscard]] measure::PlainWork plain_work(const measure::Configuration& configuration,
                                            const measure::VolumeWork& work);

}  // namespace triptych::volume_suite
