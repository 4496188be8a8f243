#include "backends/gl/program.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <vector>

#include "core/error.hpp"
#include "measure/contract/dump.hpp"
#include "technique/sources.hpp"
#include "triptych_backend_gl_embedded.hpp"

namespace triptych::gl_backend {
namespace {

// Returns the extension that provides a stage. Other stages must not mention GL_ARB_compute_shader,
// because NVIDIA's compiler treats every source that mentions it as a compute shader.
std::string_view stage_extension(GLenum type) {
  switch (type) {
    case GL_COMPUTE_SHADER:
      return "#extension GL_ARB_compute_shader : enable\n";
    case GL_TESS_CONTROL_SHADER:
    case GL_TESS_EVALUATION_SHADER:
      return "#extension GL_ARB_tessellation_shader : enable\n";
    default:
      return {};
  }
}

// Before GLSL 4.30, everything that the shared source needs comes from extensions.
std::string version_lines(const Api& gl, GLenum type) {
  if (gl.at_least(4, 5)) return "#version 450 core\n";
  if (gl.at_least(4, 3)) return "#version 430 core\n";
  std::string lines =
      "#version 330 core\n"
      "#extension GL_ARB_shading_language_420pack : enable\n"
      "#extension GL_ARB_shader_storage_buffer_object : enable\n"
      "#extension GL_ARB_shader_image_load_store : enable\n"
      "#extension GL_ARB_gpu_shader5 : enable\n";
  lines += stage_extension(type);
  // This qualifier exists only since GLSL 4.00 or with the extension.
  if (gl.ARB_gpu_shader5 == 0) lines += "#define precise\n";
  return lines;
}

std::string constant_lines(const Constants& constants) {
  return fmt::format(
      "#define TRI_MANUAL_SAMPLER {:d}\n#define TRI_SHADING {:d}\n#define TRI_COUNT {:d}\n"
      "#define TRI_SPEED_OF_LIGHT {:d}\n#define TRI_FAULT {}\n#define TRI_OPACITY_FORM {}\n"
      "#define TRI_PREINTEGRATED {}\n#define TRI_LEAPS {:d}\n#define TRI_ADAPT {:d}\n"
      "#define TRI_PRECISION {}\n#define TRI_LONG_RAYS {:d}\n"
      "#define TRI_PACKED {:d}\n#define TRI_VOXEL_BITS {}\n{}{}",
      int{constants.manual_sampler}, int{constants.shading}, int{constants.count},
      int{constants.speed_of_light}, constants.fault, constants.opacity_form,
      constants.preintegrated, int{constants.leaps}, int{constants.adapt}, constants.precision,
      int{constants.long_rays}, int{constants.packed}, constants.voxel_bits,
      constants.parts ? "#define TRI_PARTS 1\n" : "",
      constants.trace ? "#define TRI_TRACE 1\n" : "");
}

// Returns the stage name for messages.
std::string_view stage_name(GLenum type) {
  switch (type) {
    case GL_VERTEX_SHADER:
      return "vertex shader";
    case GL_TESS_CONTROL_SHADER:
      return "tessellation control shader";
    case GL_TESS_EVALUATION_SHADER:
      return "tessellation evaluation shader";
    case GL_GEOMETRY_SHADER:
      return "geometry shader";
    case GL_FRAGMENT_SHADER:
      return "fragment shader";
    default:
      return "compute shader";
  }
}

// Returns the file-name extension by which glslang recognizes the stage.
std::string_view extension_of(GLenum type) {
  switch (type) {
    case GL_VERTEX_SHADER:
      return "vert";
    case GL_TESS_CONTROL_SHADER:
      return "tesc";
    case GL_TESS_EVALUATION_SHADER:
      return "tese";
    case GL_GEOMETRY_SHADER:
      return "geom";
    case GL_FRAGMENT_SHADER:
      return "frag";
    default:
      return "comp";
  }
}

// Returns the log of a shader or a program. The functions that read the two logs have different
// names but the same parameters.
template <class GetSize, class GetLog>
std::string log_of(GLuint name, GetSize get_size, GetLog get_log) {
  GLint size = 0;
  get_size(name, GL_INFO_LOG_LENGTH, &size);
  if (size <= 0) return fmt::format("the driver provides no log: GL_INFO_LOG_LENGTH is {}", size);
  std::string log(static_cast<std::size_t>(size), '\0');
  GLsizei length = 0;
  get_log(name, size, &length, log.data());
  // Some drivers return a length of -1, or do not write the length.
  log.resize(length > 0 && length <= size ? static_cast<std::size_t>(length) : log.find('\0'));
  return log;
}

Shader compile(const Api& gl, const Stage& stage) {
  Shader shader(gl, gl.CreateShader(stage.type));
  const char* text = stage.source.data();
  const auto size = static_cast<GLint>(stage.source.size());
  gl.ShaderSource(shader.get(), 1, &text, &size);
  gl.CompileShader(shader.get());
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(shader.get(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_FALSE) {
    throw core::ApiError("glCompileShader", "GL_FALSE",
                         fmt::format("{}: {}", stage_name(stage.type),
                                     log_of(shader.get(), gl.GetShaderiv, gl.GetShaderInfoLog)));
  }
  return shader;
}

}  // namespace

Stage plain_stage(const Api& gl, GLenum type, std::string_view main_file) {
  return {type, version_lines(gl, type).append(embedded(main_file)), std::string(main_file)};
}

Stage shared_stage(const Api& gl, GLenum type, std::string_view constant_lines,
                   std::span<const std::string_view> files) {
  std::string source =
      version_lines(gl, type).append(constant_lines).append(embedded("prelude.glsl"));
  source.append(technique::source("prelude.glsl"));
  for (const std::string_view file : files) source.append(technique::whole_source(file));
  const std::string_view last = files.empty() ? std::string_view() : files.back();
  return {type, std::move(source), std::string(last.substr(0, last.rfind(".glsl")))};
}

Stage volume_stage(const Api& gl, GLenum type, const Constants& constants,
                   std::string_view main_file) {
  std::vector<std::string_view> files{"volume_math.h", "volume_preintegration.h",
                                      "volume/raycast/parameters.glsl"};
  if (constants.cells) {
    files.emplace_back("raycast_cells.glsl");
  } else {
    files.insert(files.end(), {"preintegrated.glsl", "raycast.glsl"});
  }
  Stage stage = shared_stage(gl, type, constant_lines(constants), files);
  stage.source.append(embedded(main_file));
  stage.name = main_file;
  return stage;
}

Program link(const Api& gl, std::span<const Stage> stages) {
  const auto begin = std::chrono::steady_clock::now();
  Program program(gl, gl.CreateProgram());
  std::vector<Shader> shaders;
  for (const Stage& stage : stages) {
    shaders.push_back(compile(gl, stage));
    gl.AttachShader(program.get(), shaders.back().get());
  }
  std::vector<Api::LinkedStage> linked_stages;
  for (const Stage& stage : stages) linked_stages.push_back({stage.type, stage.name});
  gl.begin_link(std::move(linked_stages));
  gl.LinkProgram(program.get());
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program.get(), GL_LINK_STATUS, &linked);
  if (linked == GL_FALSE) {
    throw core::ApiError("glLinkProgram", "GL_FALSE",
                         log_of(program.get(), gl.GetProgramiv, gl.GetProgramInfoLog));
  }
  if (gl.labelled) {
    std::string name;
    for (const Stage& stage : stages)
      name += fmt::format("{}{}", name.empty() ? "" : ", ", stage_name(stage.type));
    gl.ObjectLabel(GL_PROGRAM, program.get(), static_cast<GLsizei>(name.size()), name.data());
  }
  gl.check("glLinkProgram");
  if (measure::dump_folder()) {
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    for (const Stage& stage : stages) {
      measure::write_dump("shader", extension_of(stage.type), stage.source,
                          fmt::format("{}; part of a program with {} stages, which was compiled "
                                      "and linked in {:.1f} ms",
                                      stage_name(stage.type), stages.size(), took.count()));
    }
  }
  return program;
}

}  // namespace triptych::gl_backend
