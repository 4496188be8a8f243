#pragma once

namespace triptych::measure {

// The index-th of `count` parts of a plan, counted from 1. As far as possible, each part gets the
// same number of whole data sets. The configurations of the remaining data sets are distributed one
// by one, so that the numbers of these differ by at most one between parts.
struct Shard {
  int index = 1;
  int count = 1;
};

}  // namespace triptych::measure
