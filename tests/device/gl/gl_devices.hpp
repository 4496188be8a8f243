#pragma once
// Opens the devices of the API for the tests in this folder.

#include <array>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <utility>

#include "backends/gl/backend.hpp"
#include "tests/support/device_cases.hpp"

namespace triptych::gl_backend {

using test::draw_image;
using test::largest_difference;
using test::make_scene;
using test::make_work;
using test::SceneOptions;

// Uses debug contexts, so that a test fails if the driver reports any error message.
inline std::unique_ptr<measure::Backend> backend_under_test() {
  setenv("TRIPTYCH_GL_DEBUG", "1", 1);
  return make_backend();
}

template <class Check>
void for_each_device(Check&& check) {
  test::for_each_device_of(*backend_under_test(), std::forward<Check>(check));
}

inline constexpr std::array<std::string_view, 2> image_techniques{"raycast", "raycast_fragment"};

}  // namespace triptych::gl_backend
