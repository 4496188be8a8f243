#pragma once
// Whether all configurations together are slower than the anchors let expect; part of the
// correlation model.

#include <optional>
#include <span>

#include "judge/correlation/model.hpp"

namespace triptych::judge {

// What B's times changed by since it was accepted, in the median; nullopt where it never was.
[[nodiscard]] std::optional<double> change_since_acceptance(std::span<const CorrelationCase> cases,
                                                            bool of_anchors);

// Fills `result.global` and the anchors' intercept. `fit`: the configurations' line;
// `beside_anchors` as of correlate().
void judge_program(std::span<const CorrelationCase> cases, const RobustLine& fit,
                   const KnownVariance& beside_anchors, Correlation& result);

// What several values y with variances s² + eᵢ have in common, eᵢ known and s² not: s² by Paule and
// Mandel (1982), from Σ(y − ȳ)²/(s² + e) = k − 1, ȳ weighted by 1/(s² + e). Where all e are 0 that
// is their mean and sample variance.
struct RandomEffects {
  double centre = 0;
  double centre_variance = 0;  // 1/Σw
  double variance = 0;         // s²
  // Σs²/(s² + e) − 1, at least 1: what the values that are known as well as s would be worth.
  double degrees = 1;
};
struct KnownEffect {
  double value = 0;
  double variance = 0;  // e
};
// Of two effects at least, of which one has e = 0.
[[nodiscard]] RandomEffects random_effects(std::span<const KnownEffect> effects);

}  // namespace triptych::judge
