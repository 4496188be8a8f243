#pragma once
// The devices of the API, opened as the tests need them.

#include <cstdlib>
#include <memory>
#include <utility>

#include "backends/opencl/backend.hpp"
#include "tests/support/device_cases.hpp"

namespace triptych::opencl_backend {

using test::largest_difference;
using test::make_scene;
using test::make_work;
using test::picture;
using test::SceneOptions;

// Sets the environment in which the program starts its workers. Without it, PoCL runs small
// launches on one thread.
inline std::unique_ptr<measure::Backend> backend_under_test() {
  setenv("POCL_PTHREAD_MIN_WGS", "1", 0);
  return make_backend();
}

template <class Check>
void for_each_device(Check&& check) {
  test::for_each_device_of(*backend_under_test(), std::forward<Check>(check));
}

}  // namespace triptych::opencl_backend
