#pragma once
// Opens the devices of the API for the tests in this folder.

#include <array>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string_view>
#include <utility>

#include "backends/vulkan/backend.hpp"
#include "tests/support/device_cases.hpp"

namespace triptych::vulkan_backend {

using test::draw_image;
using test::largest_difference;
using test::make_scene;
using test::make_work;
using test::SceneOptions;

// The volume techniques that draw an image.
inline constexpr std::array<std::string_view, 2> image_techniques{"raycast", "raycast_fragment"};

// Enables the validation layer if it is installed, so that a test fails if the layer reports
// anything.
inline std::unique_ptr<measure::Backend> backend_under_test() {
  for (const char* folder : {"/usr/share/vulkan", "/usr/local/share/vulkan", "/etc/vulkan"}) {
    if (std::filesystem::exists(std::filesystem::path(folder) / "explicit_layer.d" /
                                "VkLayer_khronos_validation.json")) {
      setenv("TRIPTYCH_VULKAN_VALIDATION", "1", 1);
    }
  }
  return make_backend();
}

template <class Check>
void for_each_device(Check&& check) {
  test::for_each_device_of(*backend_under_test(), std::forward<Check>(check));
}

}  // namespace triptych::vulkan_backend
