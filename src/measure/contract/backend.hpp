#pragma once
// The contract between everything above and one API. A backend is spoken to in techniques, never in
// API commands: devices → open → supports → prepare → frame → image.

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

// Its images carry depth (Z, distance along the view axis) and ids; its counters are
// technique::particle_counts.
struct ParticleWork {
  scene::ParticleScene scene;
  technique::ParticleOptions options;
  // From where the frame before the first was drawn, which Culling::occlusion remembers; nothing:
  // from where the others are.
  std::optional<scene::Camera> camera_before = {};

  // The work of that frame.
  [[nodiscard]] ParticleWork before() const {
    ParticleWork work = *this;
    if (camera_before) work.scene.camera = *camera_before;
    return work;
  }
};

// What is to be drawn and how. The kind of scene is the one that the technique's suite in the
// catalogue says.
struct Work {
  std::string technique;  // catalogue id
  std::variant<VolumeWork, ParticleWork> scene;
};

// A frame is made for one purpose only.
enum class Purpose : std::uint8_t {
  timing,      // nothing is counted
  statistics,  // pipeline statistics are queried; its time is never used
  counters     // a build of the device code that counts; never timed
};

struct Frame {
  // Steady clock from submitting the work to knowing it done. Read-back is outside.
  double wall_ns = 0;
  std::optional<double> device_ns;  // only for Purpose::timing, where the device tells
  record::Counts counts;            // statistics or counters; what cannot be told is absent
};

// A technique with its scene, ready to be drawn again and again: data uploaded, device code
// compiled. Destroying it frees everything on the device.
class Prepared {
 public:
  Prepared() = default;
  Prepared(const Prepared&) = delete;
  Prepared& operator=(const Prepared&) = delete;
  virtual ~Prepared() = default;

  // Overwrites everything that a frame leaves behind (image, ids, depth, counters) with values that
  // no frame leaves: until the next frame is drawn, image() reads NaN in every channel. A frame
  // that leaves the values of an earlier one is found by this. Never called within what is timed or
  // counted.
  virtual void poison() = 0;
  // Draws one frame and waits for it without spinning. Throws ApiError, DeviceLost, NotDrawn.
  [[nodiscard]] virtual Frame frame(Purpose purpose) = 0;
  // The picture of the last frame, read back.
  [[nodiscard]] virtual core::Image image() = 0;
  // Hash of the device code of the timed build, with the options it was built with.
  [[nodiscard]] virtual std::string kernel_hash() const = 0;
};

// The path a backend takes when a plan leaves `voxel` and `sampler` out: its fastest that holds the
// image bound.
struct VolumePath {
  scene::VoxelFormat voxel = scene::VoxelFormat::f32;
  technique::Sampler sampler = technique::Sampler::manual;
};

// What the choice of a path rests on.
struct VolumeKind {
  scene::VoxelFormat native = scene::VoxelFormat::f32;  // the smallest that holds the data exactly
  std::array<int, 3> size{1, 1, 1};
  std::optional<technique::Sampler> sampler = std::nullopt;  // that a plan names
  // One filtered value a sample is all that is asked for: no shading, no cells, no doubles.
  bool filter_suffices = true;
  [[nodiscard]] bool may_be_packed() const {
    return sampler.value_or(technique::Sampler::packed) == technique::Sampler::packed;
  }
};

// What a device's rasterizer leaves open: which fragments an edge covers.
struct Rasterizer {
  int sub_pixel_bits = 8;  // vertices are moved to a grid of 2⁻ᵇ pixel
  double point_margin =
      0;  // pixels by which points are larger than their squares, and may be again
  double largest_point = 0;  // pixels, without the margin; larger sprites are quads
};

// The compiler's report about the timed build of a work.
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

  // Empty when the device can do it, else the reason: a feature it lacks, a limit the scene exceeds
  // (both numbers named), memory it does not have.
  [[nodiscard]] virtual std::optional<std::string> unsupported(const Work& work) const = 0;

  // `native` is the smallest format that holds the data exactly.
  [[nodiscard]] virtual VolumePath default_path(const VolumeKind& volume) const = 0;

  // Largest error of this device's trilinear filter, as a share of the difference between
  // neighbouring voxels, found by a probe when the device was opened; 0 within rounding for
  // Sampler::manual.
  [[nodiscard]] virtual double filter_weight_error(const VolumePath& path) const = 0;

  // Nothing where there is none.
  [[nodiscard]] virtual std::optional<Rasterizer> rasterizer() const { return std::nullopt; }

  // Bytes that the backend holds on the device now, as "buffers" and "images"; as "moved" those
  // that every frame of what is prepared moves there (technique/volume/parts.hpp). What a driver
  // takes for itself is not among them. Empty where nobody counts them.
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

// What a loader says of one platform or device that cannot be used.
struct Broken {
  std::string what;                          // "OpenCL platform Clover"
  std::string reason;                        // what the loader or the driver says
  std::optional<record::Reason> ended = {};  // how the process ended that asked
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
  // Everything the loaders list. Never throws: a platform that is broken or empty costs only itself
  // and is named in `broken`; no loader at all gives one `broken` entry.
  [[nodiscard]] virtual Listing list() const = 0;
  // Throws NotSupported when there is no such device, ApiError when it cannot be opened.
  [[nodiscard]] virtual std::unique_ptr<Device> open(std::string_view device_id) const = 0;
};

}  // namespace triptych::measure
