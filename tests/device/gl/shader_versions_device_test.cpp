// Tests that every shader conforms to the GLSL version that its first line names. A driver may
// accept newer features, but the reference compiler does not. tests/device/gl/CMakeLists.txt runs
// this test for several versions of GL.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>
#include <set>

#include "backends/gl/context.hpp"
#include "backends/gl/device.hpp"
#include "backends/gl/device_info.hpp"
#include "tests/device/gl/gl_particles.hpp"
#include "tests/support/command.hpp"
#include "tests/support/temporary_folder.hpp"

namespace triptych::gl_backend {
namespace {

// Shader sources, each with the file suffix from which the compiler recognizes the stage.
using Sources = std::set<std::pair<std::string, std::string>>;

std::string suffix_of(GLint type) {
  static const std::map<GLint, std::string> suffixes{
      {GL_VERTEX_SHADER, "vert"},          {GL_TESS_CONTROL_SHADER, "tesc"},
      {GL_TESS_EVALUATION_SHADER, "tese"}, {GL_GEOMETRY_SHADER, "geom"},
      {GL_FRAGMENT_SHADER, "frag"},        {GL_COMPUTE_SHADER, "comp"}};
  return suffixes.at(type);
}

// Adds the sources of all shaders of the context. The shaders still exist because programs use
// them.
void add_sources(const Api& gl, Sources& sources) {
  constexpr GLuint highest_name = 1000;
  for (GLuint name = 1; name < highest_name; ++name) {
    if (gl.IsShader(name) == GL_FALSE) continue;
    GLint type = 0;
    GLint size = 0;
    gl.GetShaderiv(name, GL_SHADER_TYPE, &type);
    gl.GetShaderiv(name, GL_SHADER_SOURCE_LENGTH, &size);
    std::string text(static_cast<std::size_t>(size), '\0');
    gl.GetShaderSource(name, size, nullptr, text.data());
    text.resize(std::min(text.size(), text.find('\0')));
    sources.emplace(suffix_of(type), text);
  }
}

std::vector<measure::Work> volume_works() {
  using enum technique::Skip;
  std::vector<measure::Work> works;
  for (const std::string_view technique : {"raycast", "raycast_fragment", "speed_of_light"}) {
    for (const auto skip : {none, bricks, distance}) {
      for (const bool first : {false, true}) {
        scene::VolumeScene scene = make_scene({.data = "generate:mandelbulb:8", .shading = first});
        if (!first) scene.quadrature = scene::Quadrature::preintegrated;
        technique::RaycastOptions options{.skip = skip};
        options.sampler = first ? technique::Sampler::manual : technique::Sampler::hardware;
        works.push_back(make_work(technique, scene, options));
        options.precision = technique::Precision::fp64;
        works.push_back(make_work(technique, std::move(scene), options));
      }
    }
  }
  return works;
}

std::vector<measure::Work> particle_works() {
  using enum technique::Culling;
  std::vector<measure::Work> works;
  const scene::ParticleScene scene = seen_from({{0, 0, -3, 1}}, {0, 0, 0}, 60);
  for (const std::string_view technique : particle_techniques) {
    for (const auto culling : {none, frustum, occlusion}) {
      for (const bool first : {false, true}) {
        technique::ParticleOptions options{.culling = culling};
        options.conservative_depth = first && technique != "tiles";
        if (!first && technique != "tiles" && technique != "point") {
          options.ray = technique::ComputedAt::vertex;
        }
        works.push_back(particle_work(technique, scene, options));
      }
    }
  }
  return works;
}

// Returns all sources that the device compiles for `works`, both for timing and for counting.
Sources sources_of(const Candidate& candidate, const std::vector<measure::Work>& works) {
  std::unique_ptr<Context> context = candidate.open(false);
  Context& kept = *context;
  record::Device info;
  {
    const Current current(kept);
    info = device_info(kept.gl(), "");
  }
  const auto device = make_device(std::move(info), std::move(context));
  Sources sources;
  for (const measure::Work& work : works) {
    if (device->unsupported(work)) continue;
    const auto prepared = device->prepare(work);
    static_cast<void>(prepared->frame(measure::Purpose::counters));
    const Current current(kept);
    add_sources(kept.gl(), sources);
  }
  return sources;
}

void replace_first(std::string& text, std::string_view what, std::string_view with) {
  if (const auto at = text.find(what); at != std::string::npos) text.replace(at, what.size(), with);
}

// Changes a shader so that the reference compiler accepts it. That compiler supports storage
// blocks, compute shaders and `precise` only from GLSL 4.30 on, not through the extensions that add
// them to 3.30, and gl_BaseInstanceARB only from 4.50 on.
std::string for_reference_compiler(std::string text) {
  replace_first(text, "#version 330", "#version 430");
  if (text.starts_with("#version 430")) replace_first(text, "gl_BaseInstanceARB", "0");
  return text;
}

// Returns the reason why the reference compiler rejects one of the shaders; empty if it accepts all
// of them. All shaders are compiled in one run, because starting the compiler takes longer than
// compiling.
std::string refusal(const Sources& sources) {
  const test::TemporaryFolder folder;
  std::string command = TRIPTYCH_GLSLANG;
  for (const auto& [suffix, text] : sources) {
    const std::string name = fmt::format("{}.{}", command.size(), suffix);
    command += fmt::format(" '{}'", folder.write(name, for_reference_compiler(text)).string());
  }
  const test::Result result = test::run_command(command);
  return result.code == 0 ? std::string() : result.output;
}

TEST(GlShaderVersions, ShadersConformToTheVersionTheyName) {
  std::vector<measure::Work> works = volume_works();
  std::ranges::move(particle_works(), std::back_inserter(works));
  for (const Candidate& candidate : egl_candidates()) {
    const Sources sources = sources_of(candidate, works);
    EXPECT_GT(sources.size(), 20U) << candidate.description;
    if (refusal(sources).empty()) continue;
    for (const auto& source : sources) EXPECT_EQ(refusal({source}), "") << source.second;
  }
}

}  // namespace
}  // namespace triptych::gl_backend
