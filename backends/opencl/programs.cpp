#include "backends/opencl/programs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "measure/code/capture_stderr.hpp"
#include "measure/contract/dump.hpp"
#include "technique/sources.hpp"
#include "triptych_backend_opencl_embedded.hpp"

namespace triptych::opencl_backend {
namespace {

std::string_view voxel_type(scene::VoxelFormat format) {
  switch (format) {
    case scene::VoxelFormat::u8:
      return "uchar";
    case scene::VoxelFormat::u16:
    case scene::VoxelFormat::f16:
      return "ushort";
    case scene::VoxelFormat::f32:
      return "float";
  }
  return "float";
}

}  // namespace

std::string Constants::options() const {
  // The options -cl-fast-relaxed-math and -cl-mad-enable are never used, because results must be
  // bit-identical in every run and on every device.
  return fmt::format(
      "-cl-std=CL1.2 -DTRI_MANUAL_SAMPLER={:d} -DTRI_VOXEL={} -DTRI_SHADING={:d} -DTRI_COUNT={:d} "
      "-DTRI_SPEED_OF_LIGHT={:d} -DTRI_FAULT={} -DTRI_BATCH={} "
      "-DTRI_PREINTEGRATED={} -DTRI_LEAPS={:d} -DTRI_ADAPT={:d} -DTRI_PRECISION={}{}{}{}",
      sampler == technique::Sampler::manual, voxel_type(voxel), shading, count, speed_of_light,
      static_cast<int>(fault), batch, preintegrated, leaps, adapt,
      precision == technique::Precision::fp64 ? 64 : 32, parts ? " -DTRI_PARTS=1" : "",
      voxel == scene::VoxelFormat::f16 ? " -DTRI_HALVES=1" : "", trace ? " -DTRI_TRACE=1" : "");
}

std::string program_source(const std::vector<std::string_view>& files) {
  std::string source{embedded("prelude.cl")};
  source += technique::source("volume_math.h");
  for (const std::string_view file : files) {
    const std::string_view own = embedded(file);
    source += own.empty() ? technique::source(file) : own;
  }
  return source;
}

cl::Program build(const Session& session, const std::string& source, const std::string& options) {
  const cl::Program program = checked([&] { return cl::Program(session.context, source); });
  const auto begin = std::chrono::steady_clock::now();
  try {
    program.build(session.device, options.c_str());
  } catch (const cl::Error& error) {
    const std::string log =
        checked([&] { return program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(session.device); });
    throw core::ApiError("clBuildProgram", code_name(error.err()),
                         fmt::format("with {}:\n{}", options, log));
  }
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
  if (measure::dump_folder())
    measure::write_dump("program", "cl", source,
                        fmt::format("built in {:.1f} ms with {}", took.count(), options));
  return program;
}

cl::Program Programs::get(const std::string& source, const std::string& options) {
  const std::string key = hash(source, options);
  const bool counts = options.find("-DTRI_COUNT=1") != std::string::npos;
  if (captures_ && !counts && std::ranges::find(captured_, key) == captured_.end()) {
    captured_.push_back(key);
  }
  if (const auto found = built_.find(key); found != built_.end()) return found->second.program;
  CapturedProgram built;
  const auto compile = [&] { built.program = build(session_, source, options); };
  if (captures_) {
    built.printed = measure::capture_stderr(compile);
  } else {
    compile();
  }
  return built_.emplace(key, std::move(built)).first->second.program;
}

void Programs::start_capture() {
  captures_ = true;
  captured_.clear();
}

std::vector<CapturedProgram> Programs::end_capture() {
  captures_ = false;
  std::vector<CapturedProgram> programs;
  for (const std::string& key : captured_) {
    if (const auto found = built_.find(key); found != built_.end()) {
      programs.push_back(found->second);
    }
  }
  captured_.clear();
  return programs;
}

std::string Programs::hash(const std::string& source, const std::string& options) {
  return core::content_hash(options + "\n" + source);
}

}  // namespace triptych::opencl_backend
