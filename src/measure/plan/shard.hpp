#pragma once

namespace triptych::measure {

// The index-th of `count` parts of a plan, from 1. Cut along data sets where that can be: as many
// whole ones for each as there are; what is left by configuration, so that none has more than one
// above another.
struct Shard {
  int index = 1;
  int count = 1;
};

}  // namespace triptych::measure
