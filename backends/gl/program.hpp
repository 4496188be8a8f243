#pragma once
#include <span>
#include <string>
#include <string_view>

#include "backends/gl/objects.hpp"

namespace triptych::gl_backend {

// The compile-time constants of the shared raycasting shader (technique/volume/raycast).
struct Constants {
  bool manual_sampler = true;
  bool packed = false;  // technique::Sampler::packed
  int voxel_bits = 32;
  bool shading = false;
  bool count = false;
  // only with `count`: records the history of one pixel (technique/volume/ray_trace.hpp)
  bool trace = false;
  bool speed_of_light = false;
  int fault = 0;
  int opacity_form = 0;   // result of technique::opacity_form()
  int preintegrated = 0;  // technique::preintegration_form
  bool cells = false;     // the quadrature `cells`, which has source files of its own
  bool leaps = false;
  bool adapt = false;
  bool parts = false;      // draws the volume one technique::Part at a time
  int precision = 32;      // bits of the floating-point numbers: 32 or 64
  bool long_rays = false;  // technique::has_long_rays
};

// The edge of the square of pixels that a work group draws (shaders/raycast.comp).
inline constexpr int group_edge = 8;

struct Stage {
  GLenum type = GL_COMPUTE_SHADER;
  std::string source;     // the complete source code, beginning with #version
  std::string name = {};  // the name of its last file without ".glsl", used in compiler reports
};

// Creates a stage from the given files of src/technique/, in the given order. They follow the
// #version line, `constant_lines`, and the preludes of this backend and of src/technique/. Uses the
// newest GLSL version that the context supports.
[[nodiscard]] Stage shared_stage(const Api& gl, GLenum type, std::string_view constant_lines,
                                 std::span<const std::string_view> files);

// Creates a stage from the constants, GL's prelude, the shared raycasting source, and the given
// file of backends/gl/shaders/, in this order.
[[nodiscard]] Stage volume_stage(const Api& gl, GLenum type, const Constants& constants,
                                 std::string_view main_file);
// Creates a stage from the #version line and the given file only, for stages that need no shared
// source.
[[nodiscard]] Stage plain_stage(const Api& gl, GLenum type, std::string_view main_file);

// Compiles and links the stages. Throws core::ApiError with the driver's log. If
// Api::keep_reports() was called, the context also stores the driver's reports about the generated
// code.
[[nodiscard]] Program link(const Api& gl, std::span<const Stage> stages);

}  // namespace triptych::gl_backend
