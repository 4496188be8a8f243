#pragma once

namespace triptych::measure {

// The index-th of `count` parts of a plan, counted from 1. The plan is divided by data sets as far
// as possible, with the same number of whole data sets in each part. The rest is divided by
// configuration, so that no part has more than one more than another.
struct Shard {
  int index = 1;
  int count = 1;
};

}  // namespace triptych::measure
