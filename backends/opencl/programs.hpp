#pragma once
// Device code, compiled at run time once for each set of options.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "backends/opencl/objects.hpp"
#include "scene/volume.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::opencl_backend {

// The compile-time constants of volume.cl and raycast.cl. A build that does not count, shade or
// inject a fault contains no code for these purposes.
struct Constants {
  technique::Sampler sampler = technique::Sampler::manual;
  scene::VoxelFormat voxel = scene::VoxelFormat::f32;
  bool shading = false;
  bool count = false;
  // only with `count`: records the history of one pixel (technique/volume/ray_trace.hpp)
  bool trace = false;
  bool speed_of_light = false;
  int preintegrated = 0;  // technique::preintegration_form
  bool cells = false;     // the quadrature `cells`, which has source files of its own
  bool leaps = false;     // technique::Skip::distance
  bool adapt = false;
  bool parts = false;  // draws the volume one technique::Part at a time
  technique::Precision precision = technique::Precision::fp32;
  technique::Fault fault = technique::Fault::none;
  int batch = 1;

  [[nodiscard]] std::string options() const;  // the options as passed to the compiler
};

// Returns the prelude and volume_math.h, with which every program begins, followed by the given
// files. A file is looked up in this folder and otherwise among the shared files
// (technique::source).
[[nodiscard]] std::string program_source(const std::vector<std::string_view>& files);

// Compiles a program for the session's device. Throws core::ApiError with the compiler's log.
[[nodiscard]] cl::Program build(const Session& session, const std::string& source,
                                const std::string& options);

struct CapturedProgram {
  cl::Program program;
  std::string printed;  // the driver's output on standard error during the build; empty if it was
                        // not captured
};

// The compiled programs, by source and options.
class Programs {
 public:
  explicit Programs(const Session& session) : session_(session) {}
  [[nodiscard]] cl::Program get(const std::string& source, const std::string& options);
  // Returns the content hash of the source and the options.
  [[nodiscard]] static std::string hash(const std::string& source, const std::string& options);

  // Starts a capture, which records each requested program once, except programs that count their
  // work (TRI_COUNT=1). end_capture() returns the recorded programs in the order in which they were
  // requested.
  void start_capture();
  [[nodiscard]] std::vector<CapturedProgram> end_capture();

 private:
  const Session& session_;
  std::map<std::string, CapturedProgram> built_;  // by hash
  bool captures_ = false;
  std::vector<std::string> captured_;  // hashes
};

}  // namespace triptych::opencl_backend
