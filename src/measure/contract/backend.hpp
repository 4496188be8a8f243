#pragma once
// The interface between API-independent code and the backend of one API. Callers select techniques
// by name and never call the API directly. They call the functions in this order: list → open →
// unsupported → prepare → frame → image.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "core/image.hpp"
#include "record/record.hpp"
#include "scene/particle_scene.hpp"
#include "scene/volume_scene.hpp"
#include "technique/catalogue.hpp"
#include "technique/particles/particle_options.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::measure {

struct VolumeWork {
  scene::VolumeScene scene;
  technique::RaycastOptions options;
};

// A scene with particles. In addition to colour, its images contain for each pixel the depth (Z,
// the distance along the view axis) and the id of the visible particle. Its counters are those in
// technique::particle_counts.
struct ParticleWork {
  scene::ParticleScene scene;
  technique::ParticleOptions options;
  // The camera of an extra frame that is drawn before the first frame, in order to set up the
  // visibility information that Culling::occlusion uses. If empty, the extra frame has the same
  // camera as all other frames.
  std::optional<scene::Camera> camera_before = {};

  // Returns a copy of this work with the camera of the extra frame.
  [[nodiscard]] ParticleWork before() const {
    ParticleWork work = *this;
    if (camera_before) work.scene.camera = *camera_before;
    return work;
  }
};

// The scene to draw, and the technique with its options. The technique's suite in the catalogue
// determines whether the scene is a volume or particles.
struct Work {
  std::string technique;  // catalogue id
  std::variant<VolumeWork, ParticleWork> scene;
};

// The purpose for which a frame is drawn. Each frame has only one purpose, so that counting never
// affects times. The device code has two builds: the timed build, which counts nothing, and the
// counting build, which also writes Triptych's counters.
enum class Purpose : std::uint8_t {
  timing,      // nothing is counted
  statistics,  // pipeline statistics are queried; the frame's time is never used
  counters     // drawn with the counting build of the device code; never timed
};

struct Frame {
  // Time on the steady clock from submitting the work until the program knows that it has finished.
  // Reading the image back is not included.
  double wall_ns = 0;
  std::optional<double> device_ns;  // only for Purpose::timing, if the device reports it
  record::Counts counts;            // statistics or counters; absent if they cannot be counted
};

// A technique with its scene, ready to be drawn repeatedly: the data are uploaded and the device
// code is compiled. Destroying it frees everything on the device.
class Prepared {
 public:
  Prepared() = default;
  Prepared(const Prepared&) = delete;
  Prepared& operator=(const Prepared&) = delete;
  virtual ~Prepared() = default;

  // Overwrites all outputs of a frame (image, ids, depth, counters) with values that no frame
  // produces. Until the next frame is drawn, image() returns NaN in every channel. Without this
  // function, the outputs of an earlier frame would remain in place if a frame is not drawn, and
  // would seem correct. poison() is never called within the timed or counted part of a frame.
  virtual void poison() = 0;
  // Draws one frame and waits for it without spinning. Throws ApiError, DeviceLost or NotDrawn.
  [[nodiscard]] virtual Frame frame(Purpose purpose) = 0;
  // Reads back the image of the latest frame from the device.
  [[nodiscard]] virtual core::Image image() = 0;
  // Returns the hash of the timed build's device code and build options.
  [[nodiscard]] virtual std::string kernel_hash() const = 0;
};

// The voxel format and the sampler that a backend chooses if a plan does not set them: the fastest
// combination whose image stays within its error bound.
struct VolumePath {
  scene::VoxelFormat voxel = scene::VoxelFormat::f32;
  technique::Sampler sampler = technique::Sampler::manual;
};

// The properties on which the choice of a VolumePath depends.
struct VolumeKind {
  // The smallest format that represents the data exactly.
  scene::VoxelFormat native = scene::VoxelFormat::f32;
  std::array<int, 3> size{1, 1, 1};
  std::optional<technique::Sampler> sampler = std::nullopt;  // the sampler set by the plan, if any
  // Whether one value from the trilinear filter is sufficient for each sample. This is not the case
  // for shading, for the quadrature `cells` (which needs the eight voxels around a sample), for
  // double precision, and for volumes that are drawn in parts (technique/volume/parts.hpp).
  bool filter_suffices = true;
  [[nodiscard]] bool may_be_packed() const {
    return sampler.value_or(technique::Sampler::packed) == technique::Sampler::packed;
  }
};

// Properties of the device's rasterizer that the API leaves to the implementation, but that
// determine which fragments a primitive covers.
struct Rasterizer {
  int sub_pixel_bits = 8;  // vertices are snapped to a grid of 2⁻ᵇ pixels, where b is this number
  // The number of pixels by which Triptych makes points larger than their sprites, because a driver
  // may round point sizes down by up to this amount. A driver may also round them up by up to this
  // amount.
  double point_margin = 0;
  double largest_point = 0;  // largest point in pixels, without margin; larger sprites become quads
};

// The compiler's report about the timed build (the build of the device code that writes no
// counters).
struct Compiled {
  record::Code code;
  std::map<std::string, std::string> listings;  // disassemblies by content hash
};

class Device {
 public:
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  virtual ~Device() = default;

  [[nodiscard]] virtual const record::Device& info() const = 0;

  // Returns nullopt if the device can draw the work, and otherwise the reason why it cannot: a
  // missing feature, a limit that the scene exceeds (with both numbers), or insufficient memory.
  [[nodiscard]] virtual std::optional<std::string> unsupported(const Work& work) const = 0;

  [[nodiscard]] virtual VolumePath default_path(const VolumeKind& volume) const = 0;

  // Returns the largest error of this device's trilinear filter, as a fraction of the difference
  // between neighbouring voxels. A probe measures the error, but the result is at most
  // technique::allowed_filter_error(), so that a faulty filter does not widen the error bounds. The
  // result is 0 for all samplers except Sampler::hardware, because they do not use the filter.
  [[nodiscard]] virtual double filter_weight_error(const VolumePath& path) const = 0;

  // Returns nullopt if the device has no rasterizer.
  [[nodiscard]] virtual std::optional<Rasterizer> rasterizer() const { return std::nullopt; }

  // Returns the number of bytes that the backend has currently allocated on the device, as
  // "buffers" and "images". "moved" is the number of bytes that every frame of the prepared work
  // uploads to the device (technique/volume/parts.hpp). Memory that the driver allocates for itself
  // is not included. The result is empty if the backend does not count its memory.
  [[nodiscard]] virtual record::Counts memory() const { return {}; }

  // Throws NotSupported, ApiError or DeviceLost.
  [[nodiscard]] virtual std::unique_ptr<Prepared> prepare(const Work& work) = 0;

  // Compiles the timed build and returns the compiler's report, without drawing anything. On a
  // compile-only device (record::Device::compiles_for), no data are uploaded either, and frame()
  // and image() throw NotSupported. Throws the same exceptions as prepare(), and NotSupported if
  // the driver reports nothing.
  [[nodiscard]] virtual Compiled compile(const Work& /*work*/) {
    throw core::NotSupported("this driver reports no statistics for the code that it generates");
  }
};

// A loader's report about a platform or device that cannot be used.
struct Broken {
  std::string what;                          // such as "OpenCL platform Clover"
  std::string reason;                        // the message of the loader or the driver
  std::optional<record::Reason> ended = {};  // how the process that enumerates devices failed
};

struct Listing {
  std::vector<record::Device> devices;
  std::vector<Broken> broken;
};

class Backend {
 public:
  Backend() = default;
  Backend(const Backend&) = delete;
  Backend& operator=(const Backend&) = delete;
  virtual ~Backend() = default;

  [[nodiscard]] virtual std::string_view api() const = 0;
  // Lists all devices that the loaders report. Never throws. A platform that is broken or empty is
  // added to `broken` and does not affect other platforms. If no loader is installed, `broken` has
  // one entry.
  [[nodiscard]] virtual Listing list() const = 0;
  // Throws NotSupported if there is no such device, and ApiError if the device cannot be opened.
  [[nodiscard]] virtual std::unique_ptr<Device> open(std::string_view device_id) const = 0;
};

}  // namespace triptych::measure
