#pragma once
// Finds volume configurations that do exactly the same work (measure::Suite::plain).

#include "measure/contract/suite.hpp"

namespace triptych::volume_suite {

// If no brick is empty, skip=distance does the same work as skip=none, because each ray detects
// this immediately and takes every sample. Stepping from brick to brick (skip=bricks) causes
// additional work even in this case. Whether early termination changes the work is determined later
// by comparing images, except for speed_of_light, which ignores early termination.
[[nodiscard]] measure::PlainWork plain_work(const measure::Configuration& configuration,
                                            const measure::VolumeWork& work);

}  // namespace triptych::volume_suite
