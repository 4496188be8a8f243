#pragma once
// The API's devices, opened as its cases want them.

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

// As the program starts its workers: PoCL leaves small launches on one thread otherwise.
inline std::unique_ptr<measure::Backend> backend_under_test() {
  setenv("POCL_PTHREAD_MIN_WGS", "1", 0);
  return make_backend();
}

template <class Check>
void for_each_device(Check&& check) {
  test::for_each_device_of(*backend_under_test(), std::forward<Check>(check));
}

}  // namespace triptych::opencl_backend
