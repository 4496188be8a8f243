#pragma once
// Elementary functions whose results are bit-identical on every machine. They are built from + − ×
// ÷, floor and exact scaling by powers of two, because implementations of the C library's sin, exp
// and log differ in their last bits. The results are accurate to a few units in the 16th digit.

namespace triptych::scene {

// Return the sine and cosine of an angle in turns (1 = 360°). They are exact at multiples of a
// quarter turn. The sine is an odd function, and the cosine is even.
[[nodiscard]] double sine_turns(double turns);
[[nodiscard]] double cosine_turns(double turns);

// Returns e^x for x ≤ 700. Returns 0 for x < −700, so that no result is denormal.
[[nodiscard]] double exponential(double x);

// Returns the natural logarithm of a positive, finite number.
[[nodiscard]] double logarithm(double x);

// Returns ln(1 + x) for x ≥ −1, without loss of accuracy for small x. Returns −∞ for x = −1.
[[nodiscard]] double logarithm_of_1_plus(double x);

}  // namespace triptych::scene
