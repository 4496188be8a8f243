#pragma once

namespace triptych::measure {

// One of the `count` parts into which a plan is divided. `index` is the 1-based number of the part.
// Every part gets the same number of complete data sets (all configurations with the same data). If
// the number of data sets is not a multiple of `count`, the configurations of the remaining data
// sets are distributed one by one, so that their numbers in any two parts differ by at most one.
struct Shard {
  int index = 1;
  int count = 1;
};

}  // namespace triptych::measure
