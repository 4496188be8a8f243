#pragma once
// What a volume cannot tell apart (measure::Suite::plain).

#include "measure/contract/suite.hpp"

namespace triptych::volume_suite {

// Leaps over empty space where no brick is empty: they see that at a glance and take every sample.
// (A walk from brick to brick is work even there.) Early termination is left to what pictures tell,
// and is none of what speed_of_light does.
[[nodiscard]] measure::PlainWork plain_work(const measure::Configuration& configuration,
                                            const measure::VolumeWork& work);

}  // namespace triptych::volume_suite
