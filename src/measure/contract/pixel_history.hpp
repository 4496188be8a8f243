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

// The message of the exception that TracesPixel::trace() throws for a work whose samples cannot be
// recorded.
inline constexpr const char* not_traced =
    "the history of a pixel cannot be recorded with quadrature=cells; use quadrature=midpoint or "
    "quadrature=preintegrated";

// A prepared work whose device code has an additional build, which records the samples of one
// pixel. This build is the counting build (the build that writes Triptych's counters) with
// additional code for recording.
class TracesPixel {
 public:
  TracesPixel() = default;
  TracesPixel(const TracesPixel&) = delete;
  TracesPixel& operator=(const TracesPixel&) = delete;
  virtual ~TracesPixel() = default;

  // Draws the frame and returns the samples of the pixel (x, y). Prepared::image() then returns the
  // image of this frame. Throws the same exceptions as Prepared::frame(), and NotSupported if the
  // technique cannot record samples.
  [[nodiscard]] virtual technique::RayTrace trace(int x, int y) = 0;
};

// A suite whose reference renderer can report the samples of one pixel of a volume.
class ExpectsRay {
 public:
  ExpectsRay() = default;
  ExpectsRay(const ExpectsRay&) = delete;
  ExpectsRay& operator=(const ExpectsRay&) = delete;
  virtual ~ExpectsRay() = default;

  // Returns the expected samples of the pixel (x, y). All other parameters have the same meaning as
  // in SuiteWithTruth::truth(). Throws NotSupported for a quadrature whose samples cannot be
  // compared one by one.
  [[nodiscard]] virtual accuracy::ExpectedRay expected_ray(
      const Configuration& configuration, const std::map<std::string, double>& precision, int x,
      int y) = 0;
};

// A suite whose reference renderer can report the visible surface in a pixel for a subset of the
// particles.
class ExpectsSprites {
 public:
  ExpectsSprites() = default;
  ExpectsSprites(const ExpectsSprites&) = delete;
  ExpectsSprites& operator=(const ExpectsSprites&) = delete;
  virtual ~ExpectsSprites() = default;

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
