#pragma once
// Opens the devices of the API for the tests in this folder.

#include <cstdlib>
#include <memory>
#include <utility>

#include "backends/opencl/backend.hpp"
#include "tests/support/device_cases.hpp"

namespace triptych::opencl_backend {

using test::draw_image;
using test::largest_difference;
using test::make_scene;
using test::make_work;
using test::SceneOptions;

// Sets the environment in which Triptych starts its workers. Without it, PoCL runs small launches
// on a single thread.
inline std::unique_ptr<measure::Backend> backend_under_test() {
  setenv("POCL_PTHREAD_MIN_WGS", "1", 0);
  return make_backend();
}

template <class Check>
void for_each_device(Check&& check) {
  test::for_each_device_of(*backend_under_test(), std::forward<Check>(check));
}

}  // namespace triptych::opencl_backend
