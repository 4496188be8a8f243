#pragma once
// The interface between API-independent code and one API. Callers name techniques and never use
// commands of the API: list → open → unsupported → prepare → frame → image.

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

// The images have depth (Z, the distance along the view axis) and ids. The counters are
// technique::particle_counts.
struct ParticleWork {
  scene::ParticleScene scene;
  technique::ParticleOptions options;
  // The camera of a frame that is drawn before the first one. Culling::occlusion uses the
  // visibility from that frame. If empty, that frame has the same camera as all others.
  std::optional<scene::Camera> camera_before = {};

  // The work with that camera.
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

// Each frame has only one purpose, so that counting never affects times.
enum class Purpose : std::uint8_t {
  timing,      // nothing is counted
  statistics,  // pipeline statistics are queried; its time is never used
  counters     // a build of the device code that counts; never timed
};

struct Frame {
  // Time on the steady clock from submitting the work until the program knows that it has finished.
  // Reading the image back is not included.
  double wall_ns = 0;
  std::optional<double> device_ns;  // only for Purpose::timing, if the device reports it
  record::Counts counts;            // statistics or counters; what cannot be counted is absent
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
  // produces: until the next frame is drawn, image() returns NaN in every channel. This reveals a
  // frame that was not drawn and left the values of an earlier one. It is never called within the
  // timed or counted part of a frame.
  virtual void poison() = 0;
  // Draws one frame and waits for it without spinning. Throws ApiError, DeviceLost, NotDrawn.
  [[nodiscard]] virtual Frame frame(Purpose purpose) = 0;
  // The image of the last frame, read back.
  [[nodiscard]] virtual core::Image image() = 0;
  // The hash of the device code of the timed build and the options with which it was built.
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
  std::optional<technique::Sampler> sampler = std::nullopt;  // the one that the plan sets, if any
  // One filtered value for each sample is sufficient: there is no shading, and neither cells nor
  // doubles are needed.
  bool filter_suffices = true;
  [[nodiscard]] bool may_be_packed() const {
    return sampler.value_or(technique::Sampler::packed) == technique::Sampler::packed;
  }
};

// The properties of the device's rasterizer that the API does not specify and that determine which
// fragments an edge covers.
struct Rasterizer {
  int sub_pixel_bits = 8;  // vertices are moved to a grid of 2⁻ᵇ pixel
  // Triptych makes points larger than their sprites by this many pixels, because a driver may round
  // sizes down. A driver may round them up by as much in addition.
  double point_margin = 0;
  double largest_point = 0;  // pixels, without the margin; larger sprites are quads
};

// The compiler's report about the timed build.
struct Compiled {
  record::Code code;
  std::map<std::string, std::string> listings;  // disassembly by its content hash
};

class Device {
 public:
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  virtual ~Device() = default;

  [[nodiscard]] virtual const record::Device& info() const = 0;

  // Empty if the device can do it. Otherwise the reason: a feature that it lacks, a limit that the
  // scene exceeds (with both numbers), or memory that it does not have.
  [[nodiscard]] virtual std::optional<std::string> unsupported(const Work& work) const = 0;

  [[nodiscard]] virtual VolumePath default_path(const VolumeKind& volume) const = 0;

  // The largest error of this device's trilinear filter, as a share of the difference between
  // neighbouring voxels. A probe measured it when the device was opened. For Sampler::manual it is
  // 0 except for rounding.
  [[nodiscard]] virtual double filter_weight_error(const VolumePath& path) const = 0;

  // nullopt if the device has no rasterizer.
  [[nodiscard]] virtual std::optional<Rasterizer> rasterizer() const { return std::nullopt; }

  // The bytes that the backend currently has allocated on the device, as "buffers" and "images".
  // "moved" counts the bytes that every frame of the prepared work uploads to the device
  // (technique/volume/parts.hpp). Memory that the driver allocates for itself is not included.
  // Empty if the backend does not count them.
  [[nodiscard]] virtual record::Counts memory() const { return {}; }

  // Throws NotSupported, ApiError, DeviceLost.
  [[nodiscard]] virtual std::unique_ptr<Prepared> prepare(const Work& work) = 0;

  // Compiles the timed build and returns the compiler's report. Nothing is drawn. On a device with
  // record::Device::compiles_for nothing is executed and no data are moved; frame() and image()
  // throw NotSupported there. Throws as prepare() does, and NotSupported if the driver reports
  // nothing.
  [[nodiscard]] virtual Compiled compile(const Work& /*work*/) {
    throw core::NotSupported("this driver reports no statistics of the code that it generates");
  }
};

// A loader's report about a platform or device that cannot be used.
struct Broken {
  std::string what;                          // "OpenCL platform Clover"
  std::string reason;                        // the message of the loader or the driver
  std::optional<record::Reason> ended = {};  // how the process that listed it ended
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
  // Everything that the loaders list. Never throws: a platform that is broken or empty is listed in
  // `broken` and does not affect the others. If there is no loader, there is one `broken` entry.
  [[nodiscard]] virtual Listing list() const = 0;
  // Throws NotSupported if there is no such device, ApiError if it cannot be opened.
  [[nodiscard]] virtual std::unique_ptr<Device> open(std::string_view device_id) const = 0;
};

}  // namespace triptych::measure
