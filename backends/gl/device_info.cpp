#include "backends/gl/device_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <string>
#include <utility>

#include "backends/gl/api.hpp"
#include "measure/system/compile_only.hpp"
#include "measure/system/cpu_features.hpp"

namespace triptych::gl_backend {
namespace {

// Mesa's environment variables that select the driver, or that change its generated code or its
// capabilities.
constexpr std::array<std::string_view, 11> code_variables{"GALLIUM_DRIVER",
                                                          "GALLIUM_OVERRIDE_CPU_CAPS",
                                                          "GALLIVM_DEBUG",
                                                          "GALLIVM_PERF",
                                                          "LIBGL_ALWAYS_SOFTWARE",
                                                          "LP_NATIVE_VECTOR_WIDTH",
                                                          "LP_NUM_THREADS",
                                                          "MESA_EXTENSION_OVERRIDE",
                                                          "MESA_GL_VERSION_OVERRIDE",
                                                          "MESA_LOADER_DRIVER_OVERRIDE",
                                                          "TRIPTYCH_GL_DEBUG"};

// Layered drivers, which forward all work to another driver. The renderer string of a layered
// driver begins with `start`.
struct Layered {
  std::string_view start;
  std::string_view name;
};
constexpr std::array<Layered, 5> layered_drivers{{{"zink", "zink"},
                                                  {"virgl", "virgl"},
                                                  {"ANGLE", "angle"},
                                                  {"D3D12", "d3d12"},
                                                  {"gl4es", "gl4es"}}};

const Layered* layered(std::string_view renderer) {
  const auto* const found = std::ranges::find_if(
      layered_drivers, [&](const Layered& each) { return renderer.starts_with(each.start); });
  return found == layered_drivers.end() ? nullptr : found;
}

// Returns the driver below a layered driver. The renderer string contains it in parentheses: "zink
// (llvmpipe (LLVM 15.0.6, 256 bits))", "virgl (…)", "ANGLE (…)".
std::string host_of(std::string_view renderer) {
  const std::size_t begin = renderer.find('(');
  const std::size_t end = renderer.rfind(')');
  if (begin == std::string_view::npos || end == std::string_view::npos || end < begin) {
    return "an unnamed driver";
  }
  return std::string(renderer.substr(begin + 1, end - begin - 1));
}

std::map<std::string, std::string> limits_of(const Api& gl) {
  std::map<std::string, std::string> limits;
  const auto add = [&](const char* name, std::int64_t value) {
    limits.emplace(name, fmt::to_string(value));
  };
  add("GL_MAX_3D_TEXTURE_SIZE", gl.limit(GL_MAX_3D_TEXTURE_SIZE));
  add("GL_SUBPIXEL_BITS", gl.limit(GL_SUBPIXEL_BITS));
  add("GL_MAX_RENDERBUFFER_SIZE", gl.limit(GL_MAX_RENDERBUFFER_SIZE));
  GLint bits = 0;
  gl.GetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
  add("GL_QUERY_COUNTER_BITS(GL_TIMESTAMP)", bits);
  if (gl.ARB_shader_storage_buffer_object != 0 || gl.VERSION_4_3 != 0) {
    add("GL_MAX_SHADER_STORAGE_BLOCK_SIZE", gl.limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE));
    add("GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS", gl.limit(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS));
  }
  if (gl.ARB_compute_shader != 0 || gl.VERSION_4_3 != 0) {
    add("GL_MAX_COMPUTE_WORK_GROUP_COUNT[0]", gl.limit(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0));
    add("GL_MAX_COMPUTE_WORK_GROUP_COUNT[1]", gl.limit(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 1));
    add("GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS", gl.limit(GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS));
  }
  return limits;
}

}  // namespace

// Returns a short name if the vendor or renderer string contains a known word, and otherwise the
// first word of the renderer string.
std::string driver_name(const std::string& vendor, const std::string& renderer) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 7> known{{
      {"llvmpipe", "llvmpipe"},
      {"softpipe", "softpipe"},
      {"SVGA3D", "svga"},
      {"radeonsi", "radeonsi"},
      {"NVIDIA", "nvidia"},
      {"AMD", "amd"},
      {"Intel", "intel"},
  }};
  if (const Layered* found = layered(renderer)) return std::string(found->name);
  for (const std::string& text : {renderer, vendor}) {
    for (const auto& [part, name] : known) {
      if (text.find(part) != std::string::npos) return std::string(name);
    }
  }
  std::string name;
  for (const char each : renderer) {
    const auto c = static_cast<unsigned char>(each);
    if (std::isalnum(c) == 0) break;
    name += static_cast<char>(std::tolower(c));
  }
  return name.empty() ? "unknown" : name;
}

// "4.5 (Core Profile) Mesa 22.3.6" and "llvmpipe (LLVM 15.0.6, 256 bits)" become "Mesa 22.3.6 (LLVM
// 15.0.6)"; "4.6.0 NVIDIA 535.54" becomes "NVIDIA 535.54".
std::string driver_version(const std::string& version, const std::string& renderer) {
  constexpr std::string_view profile = "(Core Profile) ";
  std::size_t begin = version.find(profile);
  begin = begin != std::string::npos ? begin + profile.size() : version.find(' ') + 1;
  std::string text = version.substr(begin);
  if (layered(renderer) != nullptr) return text + " on " + host_of(renderer);
  const std::size_t llvm = renderer.find("LLVM ");
  if (llvm != std::string::npos) {
    text += fmt::format(" ({})", renderer.substr(llvm, renderer.find_first_of(",)", llvm) - llvm));
  }
  return text;
}

bool is_software(const record::Device& info) {
  // The version of a layered driver includes the name of the driver below it.
  for (const std::string_view name : {"llvmpipe", "softpipe", "LLVMPIPE", "SwiftShader"}) {
    if (info.driver == name || info.driver_version.find(name) != std::string::npos) return true;
  }
  return false;
}

record::Device device_info(const Api& gl, std::string_view suffix) {
  const std::string vendor = gl.text(GL_VENDOR);
  const std::string renderer = gl.text(GL_RENDERER);
  const std::string version = gl.text(GL_VERSION);
  const std::string driver = driver_name(vendor, renderer);
  const bool plain = driver == "softpipe" && suffix == "-egl";
  record::Device info{.id = fmt::format("gl:{}{}", driver, plain ? "" : suffix),
                      .api = "gl",
                      .name = renderer,
                      .vendor = vendor,
                      .driver = driver,
                      .driver_version = driver_version(version, renderer),
                      .api_version = version.substr(0, version.find(' ')),
                      .cpu_features = {},
                      .environment = measure::set_variables(code_variables),
                      .limits = limits_of(gl)};
  if (is_software(info)) {
    info.cpu_features = measure::cpu_features();
  } else if (std::string family = measure::compiled_family(driver); !family.empty()) {
    // The id contains the driver and the GPU family, which the environment variables selected.
    // Therefore the environment need not be recorded.
    info.id = measure::compile_only_id("gl", driver, family);
    info.compiles_for = std::move(family);
    info.name = measure::without_kernel_version(std::move(info.name));
    info.environment.clear();
  }
  gl.check("glGetString");
  return info;
}

}  // namespace triptych::gl_backend
