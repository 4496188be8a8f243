#pragma once

namespace triptych::measure {

// The part of a plan with the 1-based number `index`, if the plan is divided into `count` parts. As
// far as possible, all parts have the same number of complete data sets. The configurations of the
// remaining data sets are distributed one by one, so that their numbers in any two parts differ by
// at most one.
struct Shard {
  int index = 1;
  int count = 1;
};

}  // namespace triptych::measure
