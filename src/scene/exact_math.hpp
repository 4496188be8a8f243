#pragma once
// Elementary functions with the same bits on every machine: built from + − × ÷, floor and exact
// scaling by powers of two, because the C library's sin, exp and log differ in their last bits
// between implementations. Accuracy: a few units in the 16th digit.

namespace triptych::scene {

// sin and cos of an angle in turns (1 = 360°). Exact at multiples of a quarter turn; the sine is an
// odd function and the cosine an even one.
[[nodiscard]] double sine_turns(double turns);
[[nodiscard]] double cosine_turns(double turns);

// e^x for x ≤ 700; 0 below −700, where results would become denormal.
[[nodiscard]] double exponential(double x);

// Natural logarithm of a positive, finite number.
[[nodiscard]] double logarithm(double x);

// ln(1 + x) for x ≥ −1, accurate also for small x; −∞ at −1.
[[nodiscard]] double logarithm_of_1_plus(double x);

}  // namespace triptych::scene
