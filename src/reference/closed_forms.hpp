#pragma once
// Rays whose emission–absorption integral has a closed-form solution:
//   I = ∫ c·τ·exp(−∫τ) dt,   A = 1 − exp(−∫τ),
// where τ is the extinction per unit length (in the unit of the lengths below) and c is the colour
// before premultiplication. All formulas follow from this definition. V1 … V9 are the numbers of
// the problems in this project (Etiene et al. 2014 verify volume renderers with such problems).

namespace triptych::reference {

// The premultiplied colour of one channel, and the opacity.
struct Radiance {
  double colour = 0;
  double opacity = 0;
};

// Composites `front` over `behind`.
[[nodiscard]] Radiance over(const Radiance& front, const Radiance& behind);

// Problem V1: constant τ and c over a length ℓ. The opacity is A = 1 − e^(−τℓ), and the
// premultiplied colour is I = c·A.
[[nodiscard]] Radiance v1_constant(double tau, double colour, double length);

// Problem V2: τ = k·t and c = t for 0 ≤ t ≤ 1, k ≥ 0. The premultiplied colour is
// I = −e^(−k/2) + √(π/(2k))·erf √(k/2), and the opacity is A = 1 − e^(−k/2). This follows by
// integration by parts with the transmittance e^(−kt²/2).
[[nodiscard]] Radiance v2_ramp(double k);

// Problem V3: τ = a + b·t and c = c₀ + c₁·t for 0 ≤ t ≤ l, where l is the length of the segment,
// with τ ≥ 0 everywhere. Let E = exp(−at − bt²/2) be the transmittance from 0 to t. Integration by
// parts gives the premultiplied colour
//   I = [−(c₀ + c₁t)·E]₀ˡ + c₁·∫E dt.
struct LinearSegment {
  double tau0 = 0;     // a
  double tau1 = 0;     // b
  double colour0 = 0;  // c₀
  double colour1 = 0;  // c₁
  double length = 0;
};
[[nodiscard]] Radiance v3_segment(const LinearSegment& segment);

// Returns ∫ exp(−at − bt²/2) dt over [0, length], for a + bt ≥ 0 there, with a relative error of
// about 1e-14. For b > 0, completing the square gives erf, which is expressed by erfcx to avoid
// overflow and cancellation. For b < 0 it gives Dawson's function. Optically thin segments and
// b → 0 use a Taylor series.
[[nodiscard]] double transmittance_integral(double a, double b, double length);

// Problem V4: returns the optical depth of τ = τ₀·exp(−r²/(2σ²)), where r is the distance from the
// centre, along a line at distance p from the centre, between s₀ and s₁ (measured from the point
// that is nearest to the centre): τ₀σ√(π/2)·e^(−p²/(2σ²))·[erf(s₁/(√2·σ)) − erf(s₀/(√2·σ))]. For
// the whole line it is τ₀σ√(2π)·e^(−p²/(2σ²)).
[[nodiscard]] double v4_gaussian_depth(double tau0, double sigma, double p, double s0, double s1);

// Problem V5: returns the optical depth of τ = τ₀·e^(−z/H) from height z₀ to z₁ ≠ z₀ along a ray at
// an angle θ to the axis: τ₀H·|e^(−z₀/H) − e^(−z₁/H)|/|cos θ|.
[[nodiscard]] double v5_atmosphere_depth(double tau0, double scale_height, double z0, double z1,
                                         double cosine);

// Problem V6: returns the light of two homogeneous layers; layer 1 is in front.
[[nodiscard]] Radiance v6_layers(double tau1, double colour1, double length1, double tau2,
                                 double colour2, double length2);

// Problem V9: returns the factor by which a central difference over Δ to either side changes the
// derivative of sin(kx): (sin k(x+Δ) − sin k(x−Δ))/(2Δ) = k·cos(kx) · sin(kΔ)/(kΔ).
[[nodiscard]] double v9_difference_factor(double k, double delta);

// Returns the light of V9, ∫ sinⁿ(φ + ω·t)·τ·e^(−τt) dt over [0, length], with the phase φ, the
// rate ω and the power n, for τ > 0 and an n that is 1 or even. It is computed as the Fourier sum
// of sinⁿ, with
//   ∫ e^(i(φ+ωt))·e^(−τt) dt = e^(iφ)·(e^((iω−τ)·length) − 1)/(iω − τ).
[[nodiscard]] double v9_lit_wave(double tau, int power, double phase, double rate, double length);

// Returns the scaled complementary error function e^(x²)·erfc(x) for x ≥ 0.
[[nodiscard]] double erfcx(double x);

// Returns Dawson's function e^(−x²)·∫₀ˣ e^(t²) dt.
[[nodiscard]] double dawson(double x);

}  // namespace triptych::reference
