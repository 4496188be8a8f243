#pragma once
// Device code, which is compiled at run time, once for each set of options.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "backends/opencl/objects.hpp"
#include "scene/volume.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::opencl_backend {

// The compile-time constants of volume.cl and raycast.cl. A build that does not count, shade or
// inject a fault contains no code for that.
struct Constants {
  technique::Sampler sampler = technique::Sampler::manual;
  scene::VoxelFormat voxel = scene::VoxelFormat::f32;
  bool shading = false;
  bool count = false;
  bool trace = false;  // with `count`: the history of one pixel (technique/volume/ray_trace.hpp)
  bool speed_of_light = false;
  int preintegrated = 0;  // technique::preintegration_form
  bool cells = false;     // the technique has its own source
  bool leaps = false;     // technique::Skip::distance
  bool adapt = false;
  bool parts = false;  // the volume is drawn one technique::Part at a time
  technique::Precision precision = technique::Precision::fp32;
  technique::Fault fault = technique::Fault::none;
  int batch = 1;

  [[nodiscard]] std::string options() const;  // the options in the form that the compiler takes
};

// The beginning of every program (the prelude, volume_math.h), followed by the given files: those
// of this folder, or otherwise shared ones (technique::source).
[[nodiscard]] std::string program_source(const std::vector<std::string_view>& files);

// Compiles for the session's device. Throws core::ApiError with the compiler's log.
[[nodiscard]] cl::Program build(const Session& session, const std::string& source,
                                const std::string& options);

struct CapturedProgram {
  cl::Program program;
  std::string printed;  // the text that the driver wrote to standard error during the build; empty
                        // if it was not captured
};

// Programs that have been compiled, by source and options.
class Programs {
 public:
  explicit Programs(const Session& session) : session_(session) {}
  [[nodiscard]] cl::Program get(const std::string& source, const std::string& options);
  // The content hash of source and options.
  [[nodiscard]] static std::string hash(const std::string& source, const std::string& options);

  // From now on, the programs that are requested are recorded once each, except those that count.
  // end_capture() returns them in that order.
  void start_capture();
  [[nodiscard]] std::vector<CapturedProgram> end_capture();

 private:
  const Session& session_;
  std::map<std::string, CapturedProgram> built_;  // the key is the hash
  bool captures_ = false;
  std::vector<std::string> captured_;  // hashes
};

}  // namespace triptych::opencl_backend
