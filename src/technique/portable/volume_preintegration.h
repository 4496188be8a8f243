// Maths for quadrature=preintegrated, in the common subset of C++, GLSL and OpenCL C. It uses volume_math.h.
//
// In this file, a cell is the interval between two adjacent entries of the transfer function. A step is cut at
// entries into at most three pieces: the remainder of the first cell, whole cells (whose integrals are in a table,
// preintegration.hpp), and the beginning of the last cell. For each piece, the optical depth D is known. The colour
// of the piece is a function of y, the share of D that the light has passed. It is represented by its first three
// Legendre coefficients on [0, 1]: c(y) = a0 + a1·P1(y) + a2·P2(y). The light of the piece is then
//  D·∫c(y)·e^(−Dy) dy = (1 − e^(−D))·(a0 − a1·L + a2·(1 − 3L/z)),   z = D/2,  L = coth z − 1/z,
// because ∫Pn(y)·e^(−Dy) dy = (−1)ⁿ·e^(−z)·i_n(z), where i_n are the modified spherical Bessel functions.
//
// With three coefficients, the light of a piece of optical depth D has an error of R·D⁴/635, where R is the range
// of the colour. This is accurate enough for a depth of up to 1, but not for much larger depths. If the total depth
// of the whole cells of a step exceeds TRI_DEEPEST_CHUNK, they are therefore processed from front to back, in chunks
// that do not exceed this depth. TRI_DEEPEST_CHUNK is a depth in powers of two: a depth d transmits 2^−d of the light.
// A single cell may be deeper, because colours are linear along it. Once the processed chunks of a step transmit no
// more than TRI_LEAST_LEFT, all remaining cells form one chunk. This code exists only in single precision, because its
// tables contain floats.
#if TRI_PRECISION == 32

#define TRI_DEEPEST_CHUNK 0.5f
#define TRI_LEAST_LEFT 9.5367432e-7f

// Returns the mean of log2(1 − alpha) while alpha changes linearly from a to b. Let m be 1 minus the alpha in the
// middle, and r = |b − a|/2m. The mean of ln(m·(1 − r·x)) over −1 ≤ x ≤ 1 is ln m − Σ r^2n/(2n(2n+1)). With six
// terms, the error is below r^14/(210·(1 − r²)), and it is below 0.038 for r = 1.
TRI_FN float tri_mean_log2_1m(float a, float b) {
  float middle = 0.5f * (a + b);
  if (!(middle < 1.0f)) return -1.0e30f;
  float r = 0.5f * (b - a) / (1.0f - middle);
  float q = r * r;
  float sum = q * (0.2404491735f + q * (0.0721347520f + q * (0.0343498819f + q * (0.0200374311f +
              q * (0.0131154095f + q * 0.0092480451f)))));
  return tri_log2_1m(middle) - sum;
}

// Returns (τb − τa)/(2·mean τ), limited to [−1, 1], for an alpha that changes linearly from a to b within one cell.
// This is the relative change of the extinction τ around its mean. mean_log2 is the result of tri_mean_log2_1m.
TRI_FN float tri_tilt(float a, float b, float mean_log2) {
  float twice_mean = -1.3862943611f * mean_log2;
  float rise = (b - a) / (1.0f - 0.5f * (a + b));
  float size = rise < 0.0f ? 0.0f - rise : rise;
  if (!(twice_mean > size)) return rise < 0.0f ? -1.0f : (rise > 0.0f ? 1.0f : 0.0f);
  return rise / twice_mean;
}

// Returns w = z/L − 3 with L = coth z − 1/z, for the optical depth 2z > 0 with the given opacity. Therefore
// L = z/(3 + w) and 1 − 3L/z = w/(3 + w). For small z, this definition would suffer from cancellation, so the continued
// fraction z²/(5 + z²/(7 + …)) is used; five levels have a relative error below 4e-7 at z = 2.
TRI_FN float tri_attenuation(float z, float opacity) {
  float q = z * z;
  float near_zero = q / (5.0f + q / (7.0f + q / (9.0f + q / (11.0f + q / 13.0f))));
  float langevin = 2.0f / opacity - 1.0f - 1.0f / z;
  return z < 2.0f ? near_zero : z / langevin - 3.0f;
}

#endif
