#pragma once
// Front-to-back compositing of one ray and the bound on what a device may make of it.

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
  std::uint64_t samples = 0;  // of Truth::samples
};

// Samples are added front to back, then finish() folds them back to front, which yields the colour
// behind every sample. With a, c, T, B the opacity, colour, transmittance in front and colour
// behind of a sample, primed for the device's, the exact identity
//   I' − I = Σᵢ T'ᵢ·[(a'ᵢ − aᵢ)(cᵢ − Bᵢ) + a'ᵢ(c'ᵢ − cᵢ)]
// bounds the difference by what each primed quantity can be at most, all orders included.
// One object serves one thread; its memory is kept from ray to ray.
class Compositor {
 public:
  Compositor(const ErrorModel& model, const std::array<float, 4>& background);

  void start();
  // False when nothing behind this sample can be seen any more.
  bool add(const Looked& looked, const StepOpacity& opacity);
  [[nodiscard]] Pixel finish() const;

 private:
  struct Sample {
    std::array<double, 3> colour;
    std::array<double, 3> colour_error;
    double opacity;
    double opacity_error;
    double front;  // the largest transmittance a device may have in front of it
  };

  ErrorModel model_;
  std::array<double, 4> background_{};
  std::vector<Sample> samples_;
  double largest_ = 1;   // of the transmittance a device may have reached …
  double smallest_ = 1;  // … and the smallest
  // A device with early termination stops behind one of the samples first_stop_ … last_stop_. One
  // that takes samples together has a transmittance that is off by as much as the picture, may stop
  // as early as that allows, and as late as its last sample.
  std::size_t first_stop_ = 0;
  std::size_t last_stop_ = 0;
};

}  // namespace triptych::reference
