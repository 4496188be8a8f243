#include "reference/composite.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace triptych::reference {

namespace {
constexpr std::size_t never = std::numeric_limits<std::size_t>::max();
// If the transmittance is below this number, everything behind contributes less than half an ulp to
// a colour, if this colour is a double above 1e-3.
constexpr double invisible = 0x1.0p-64;
}  // namespace

Compositor::Compositor(const ErrorModel& model, const std::array<float, 4>& background)
    : model_(model) {
  for (std::size_t channel = 0; channel < 4; ++channel) {
    background_[channel] = static_cast<double>(background[channel]);
  }
}

void Compositor::start() {
  samples_.clear();
  largest_ = smallest_ = 1.0;
  first_stop_ = last_stop_ = never;
}

bool Compositor::add(const TableLookup& lookup, const StepOpacity& opacity) {
  const double error = std::max(opacity.hi - opacity.nominal, opacity.nominal - opacity.lo);
  samples_.push_back({lookup.colour, lookup.colour_error, opacity.nominal, error, largest_});
  const double rounding = model_.compositing_error * largest_;
  largest_ = std::min(largest_ * (1.0 - opacity.lo) + rounding, 1.0);
  smallest_ = std::max(smallest_ * (1.0 - opacity.hi) - rounding, 0.0);
  const std::size_t index = samples_.size() - 1;
  if (first_stop_ == never && smallest_ - model_.adapt < model_.ert) first_stop_ = index;
  if (last_stop_ == never && largest_ < model_.ert && model_.adapt == 0) last_stop_ = index;
  return largest_ > invisible;
}

Pixel Compositor::finish() const {
  Pixel pixel;
  pixel.rgba = background_;
  pixel.bound = model_.adapt;
  if (samples_.empty()) return pixel;
  std::array<double, 4> error{};
  std::array<double, 4> lost{};
  for (std::size_t i = samples_.size(); i-- > 0;) {
    const Sample& sample = samples_[i];
    const double opacity_hi = std::min(sample.opacity + sample.opacity_error, 1.0);
    const double opacity_lo = std::max(sample.opacity - sample.opacity_error, 0.0);
    const bool may_stop_here = first_stop_ != never && i >= first_stop_ && i <= last_stop_;
    const bool reached = last_stop_ == never || i <= last_stop_;
    for (std::size_t channel = 0; channel < 4; ++channel) {
      const double colour = channel < 3 ? sample.colour[channel] : 1.0;
      const double colour_error = channel < 3 ? sample.colour_error[channel] : 0.0;
      const double behind = pixel.rgba[channel];
      if (may_stop_here) {
        const double left = std::min(sample.front * (1.0 - opacity_lo) + model_.adapt, model_.ert);
        const double unseen = std::abs(behind - background_[channel]) + model_.adapt;
        lost[channel] = std::max(lost[channel], left * unseen);
      }
      // A relative error of the transmittance changes the light from everything behind the sample
      // by the same relative amount. In the alpha channel, opacity is computed as one minus the
      // remaining transmittance, so its error is proportional to the part that is not covered,
      // however small the weights of the samples are.
      const double scaled = channel < 3 ? std::abs(behind) : 1.0 - behind;
      if (reached && opacity_hi > 0) {
        error[channel] +=
            sample.front *
            (sample.opacity_error * std::abs(colour - behind) + opacity_hi * colour_error +
             model_.compositing_error * (opacity_hi * colour + scaled));
      }
      pixel.rgba[channel] = sample.opacity * colour + (1.0 - sample.opacity) * behind;
    }
  }
  // Each addition to the colour, including the addition of the background, rounds a value that does
  // not exceed the result.
  const double sums = static_cast<double>(samples_.size() + 1);
  for (std::size_t channel = 0; channel < 4; ++channel) {
    const double rounding = model_.compositing_error * sums *
                            (std::abs(pixel.rgba[channel]) + error[channel] + lost[channel]);
    const double computed = error[channel] + lost[channel] + rounding + model_.adapt;
    const double stored = model_.output_error * (std::abs(pixel.rgba[channel]) + computed);
    pixel.bound = std::max(pixel.bound, computed + stored);
  }
  return pixel;
}

}  // namespace triptych::reference
