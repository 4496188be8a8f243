#pragma once
// Interfaces for the history of one pixel, which consists of the device's results and the correct
// results, computed by the reference renderer. A class derived from Prepared or Suite that can
// report such results also implements one of these interfaces.

#include <cstdint>
#include <span>

#include "accuracy/ray_history.hpp"
#include "accuracy/sprite_history.hpp"
#include "measure/contract/suite.hpp"
#include "technique/volume/ray_trace.hpp"

namespace triptych::measure {

// The position of a pixel, relative to the upper left corner of the image.
struct PixelPlace {
  int x = 0;
  int y = 0;
};

// The message of the exception that PixelTracer::trace() throws for a work whose samples cannot be
// recorded, although its technique and backend can record samples.
inline constexpr const char* pixel_history_unsupported =
    "the history of a pixel cannot be recorded with quadrature=cells; use quadrature=midpoint or "
    "quadrature=preintegrated";

// The message if the device or the suite does not implement the interface below that the history
// needs.
inline constexpr const char* pixel_history_of_device_unsupported =
    "this device cannot record the history of a pixel with this technique; use another technique "
    "or a device of another API";
inline constexpr const char* pixel_history_of_suite_unsupported =
    "the reference renderer of this suite cannot compute the history of a pixel";

// A prepared work whose device code has an additional build, which records the samples of one
// pixel. This build is the counting build (the build that writes Triptych's counters) with
// additional code for recording.
class PixelTracer {
 public:
  PixelTracer() = default;
  PixelTracer(const PixelTracer&) = delete;
  PixelTracer& operator=(const PixelTracer&) = delete;
  virtual ~PixelTracer() = default;

  // Draws the frame and returns the samples of the pixel (x, y). Prepared::image() then returns the
  // image of this frame. Throws the same exceptions as Prepared::frame(), and NotSupported if the
  // technique cannot record samples.
  [[nodiscard]] virtual technique::RayTrace trace(int x, int y) = 0;
};

// A suite whose reference renderer can report the samples of one pixel of a volume.
class RayReference {
 public:
  RayReference() = default;
  RayReference(const RayReference&) = delete;
  RayReference& operator=(const RayReference&) = delete;
  virtual ~RayReference() = default;

  // Returns the expected samples of the pixel (x, y). All other parameters have the same meaning as
  // in SuiteWithTruth::truth(). Throws NotSupported for a quadrature whose samples cannot be
  // compared one by one.
  [[nodiscard]] virtual accuracy::ExpectedRay expected_ray(
      const Configuration& configuration, const std::map<std::string, double>& precision, int x,
      int y) = 0;
};

// A suite whose reference renderer can report the visible surface in a pixel for a subset of the
// particles.
class SpriteReference {
 public:
  SpriteReference() = default;
  SpriteReference(const SpriteReference&) = delete;
  SpriteReference& operator=(const SpriteReference&) = delete;
  virtual ~SpriteReference() = default;

  // Returns the indices of the particles that the ray of the pixel (x, y) may hit, from front to
  // back, including hidden particles. All other parameters have the same meaning as in
  // SuiteWithTruth::truth().
  [[nodiscard]] virtual std::vector<std::uint32_t> particles_near(
      const Configuration& configuration, const std::map<std::string, double>& precision, int x,
      int y) = 0;
  // Returns the expected result in the pixel (x, y) for a scene that consists only of these
  // particles. The error bounds are those for the complete scene.
  [[nodiscard]] virtual accuracy::ExpectedSurface expected_surface(
      const Configuration& configuration, const std::map<std::string, double>& precision,
      std::span<const std::uint32_t> particles, int x, int y) = 0;
};

}  // namespace triptych::measure
