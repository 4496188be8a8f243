#pragma once
// Front-to-back compositing of one ray, with the error bound for a device's result.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reference/opacity.hpp"
#include "reference/table.hpp"
#include "reference/volume.hpp"

namespace triptych::reference {

struct Pixel {
  std::array<double, 4> rgba{};
  double bound = 0;
  std::uint64_t samples = 0;  // see Truth::samples
};

// Samples are added from front to back. finish() then processes them from back to front, which
// yields the colour behind every sample. Let I be the colour of the pixel. Let a, c, T and B be the
// opacity of sample i, its colour, the transmittance in front of it and the colour behind it. A
// prime marks the device's quantities. The exact identity
//   I' − I = Σᵢ T'ᵢ·[(a'ᵢ − aᵢ)(cᵢ − Bᵢ) + a'ᵢ(c'ᵢ − cᵢ)]
// bounds the difference if each primed quantity is replaced by its maximum. The resulting bound
// includes errors of all orders. A Compositor must be used by only one thread, because it reuses
// its memory for the next ray.
class Compositor {
 public:
  Compositor(const ErrorModel& model, const std::array<float, 4>& background);

  void start();
  // Adds a sample. Returns false if nothing behind this sample can be visible any more.
  bool add(const TableLookup& lookup, const StepOpacity& opacity);
  [[nodiscard]] Pixel finish() const;

 private:
  struct Sample {
    std::array<double, 3> colour;
    std::array<double, 3> colour_error;
    double opacity;
    double opacity_error;
    double front;  // largest transmittance in front of the sample on a device
  };

  ErrorModel model_;
  std::array<double, 4> background_{};
  std::vector<Sample> samples_;
  double largest_ = 1;   // largest transmittance on a device so far
  double smallest_ = 1;  // smallest transmittance on a device so far
  // A device with early termination stops after one of the samples first_stop_ … last_stop_. If a
  // device draws several samples of a nearly homogeneous brick as one (factor `adapt`), its
  // transmittance may be wrong by up to ErrorModel::adapt. first_stop_ then takes this error into
  // account, and last_stop_ is not set, because the device may draw all samples.
  std::size_t first_stop_ = 0;
  std::size_t last_stop_ = 0;
};

}  // namespace triptych::reference
