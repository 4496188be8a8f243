#pragma once
// Finds configurations of a volume that do exactly the same work (measure::Suite::plain).

#include "measure/contract/suite.hpp"

namespace triptych::volume_suite {

// Skipping by leaps is the same work as no skipping if no brick is empty, because rays detect that
// at once and take every sample. Stepping from brick to brick is additional work even then. Whether
// early termination changes the work is found by comparing images; speed_of_light ignores it.
[[nodiscard]] measure::PlainWork plain_work(const measure::Configuration& configuration,
                                            const measure::VolumeWork& work);

}  // namespace triptych::volume_suite
