#pragma once
#include <span>
#include <string>
#include <string_view>

#include "backends/gl/objects.hpp"

namespace triptych::gl_backend {

// The compile-time constants of the shared raycasting source (technique/volume/raycast).
struct Constants {
  bool manual_sampler = true;
  bool packed = false;  // technique::Sampler::packed
  int voxel_bits = 32;
  bool shading = false;
  bool count = false;
  bool trace = false;  // with `count`: the history of one pixel (technique/volume/ray_trace.hpp)
  bool speed_of_light = false;
  int fault = 0;
  int opacity_form = 0;   // technique::opacity_form for the step
  int preintegrated = 0;  // technique::preintegration_form
  bool cells = false;     // the technique has its own source
  bool leaps = false;
  bool adapt = false;
  bool parts = false;      // the volume is drawn one technique::Part at a time
  int precision = 32;      // bits of a floating-point number: 32 or 64
  bool long_rays = false;  // technique::has_long_rays
};

// A work group draws a square of this many pixels on each side (shaders/raycast.comp).
inline constexpr int group_edge = 8;

struct Stage {
  GLenum type = GL_COMPUTE_SHADER;
  std::string source;     // the whole source, beginning with #version
  std::string name = {};  // the name of its last file without ".glsl", which reports use
};

// The given files of src/technique/ in that order, after the #version line, `constant_lines` and
// both preludes, in the newest GLSL that the context has.
[[nodiscard]] Stage shared_stage(const Api& gl, GLenum type, std::string_view constant_lines,
                                 std::span<const std::string_view> files);

// The shared raycasting source with the constants and GL's prelude before it, and the given file of
// backends/gl/shaders/ after it.
[[nodiscard]] Stage volume_stage(const Api& gl, GLenum type, const Constants& constants,
                                 std::string_view main_file);
// Only the given file after the #version line, for stages that share nothing.
[[nodiscard]] Stage plain_stage(const Api& gl, GLenum type, std::string_view main_file);

// Compiles and links; throws core::ApiError with the driver's log. What the driver reports about
// the code is stored in the context if it keeps reports.
[[nodiscard]] Program link(const Api& gl, std::span<const Stage> stages);

}  // namespace triptych::gl_backend
