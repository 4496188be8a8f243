#pragma once

namespace triptych::measure {

// The index-th of `count` parts of a plan, counted from 1. As far as possible, each part has the
// same number of whole data sets. The configurations of the remaining data sets are distributed one
// by one, so that each part has the same number of them or one more.
struct Shard {
  int index = 1;
  int count = 1;
};

}  // namespace triptych::measure
