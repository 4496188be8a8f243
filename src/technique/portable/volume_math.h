// Volume maths in the common subset of C++, GLSL and OpenCL C: pure functions whose arguments are scalars passed by
// value. The including file defines the TRI_ macros and `real`, which is float, or double if TRI_PRECISION is 64
// (prelude.hpp, prelude.glsl, the OpenCL backend's prelude.cl). u is the unit roundoff of `real`, 2⁻²⁴ or 2⁻⁵³.
// Float literals such as 256.0f are exact in both precisions.

// Returns the parameter range [near, far] in which o + t·d is in [0, extent]; near > far if there is no such t. It
// never divides by d = ±0, because such a ray is between the two planes for all t or for none.
TRI_FN real2 tri_slab(real o, real d, real extent) {
  real huge = 3.0e38f;
  if (d == 0.0f) {
    return (o >= 0.0f && o <= extent) ? TRI_MAKE_REAL2(-huge, huge) : TRI_MAKE_REAL2(huge, -huge);
  }
  real a = (0.0f - o) / d;
  real b = (extent - o) / d;
  return (a < b) ? TRI_MAKE_REAL2(a, b) : TRI_MAKE_REAL2(b, a);
}

// Returns the image column that column x of a launch draws. Each column before `again` draws the image column with
// the same index. The columns from `again` on inject a slowdown by drawing 1/stride of each row of tiles a second
// time. They repeat whole tiles of 16×8 pixels, because rays that are far apart take different paths and would cost
// more than their share. A tile is repeated in its own row, so that a device that statically distributes rows among
// its processors gives each processor its share of the extra work. From one row of tiles to the next, the repeated
// tiles are shifted by the golden ratio. The result may be outside the image, where nothing is drawn.
TRI_FN int tri_drawn_column(int x, int y, int again, int stride) {
  if (x < again) return x;
  int extra = x - again;
  int stagger = ((y / 8 * 40503) & 65535) * stride / 65536;
  return (extra / 16 * stride + stagger) * 16 + extra % 16;
}

// Returns the index in the output buffer of pixel (x, y) of a launch with `columns` columns. The image comes first,
// in rows of `width` pixels. The repeated pixels follow the image, because no element may be written twice.
TRI_FN int tri_output_place(int x, int y, int width, int height, int again, int columns) {
  if (x < again) return y * width + x;
  return width * height + y * (columns - again) + (x - again);
}

// Returns the number of samples along a ray that is `steps` steps long, which is ⌈steps⌉ because the last step may
// be partial. Returns 0 for an empty or invalid range.
TRI_FN int tri_sample_count(real steps) {
  if (!(steps > 0.0f)) return 0;
  return TRI_INT(TRI_CEIL(steps < 2.0e9f ? steps : TRI_TO_REAL(2.0e9f)));
}

// Returns the share of a whole step that the i-th sample covers. It is 1 for all samples except the last.
TRI_FN real tri_step_share(real steps, int i) {
  real left = steps - TRI_TO_REAL(i);
  return left < 1.0f ? (left > 0.0f ? left : TRI_TO_REAL(0)) : TRI_TO_REAL(1);
}

// Converts a normalised value to a position in the 256-entry table, in which entry k is centred at k. The position
// is clamped to [0, 255]. NaN is converted to 0.
TRI_FN real tri_table_position(real x) {
  real u = x * 256.0f - 0.5f;
  return u > 0.0f ? (u < 255.0f ? u : TRI_TO_REAL(255)) : TRI_TO_REAL(0);
}

#if TRI_PRECISION == 64
// Returns log2(1 − alpha), computed as in the single-precision version below, with an error of 6u. With
// t = (m − 1)/(m + 1) and |t| ≤ 3 − 2√2, truncating the series after t¹⁹ causes an error below
// t²⁰/(21·(1 − t²)) < 2.5e-17 = 0.3u. The remaining error consists of two roundings in t, one in the last sum of the
// series, two in products, and half a rounding in the constant. The roundings of t² are negligible, because they are
// multiplied by t² itself.
TRI_FN real tri_log2_1m(real alpha) {
  real y = 1.0f - alpha;
  int high = TRI_HIGH_WORD(y);
  int e = (high - 0x3fe6a09e) >> 20;  // 0x3fe6a09e are the upper bits of √½
  real m = TRI_WITH_HIGH_WORD(y, high - e * 1048576);
  real d = e == 0 ? 0.0f - alpha : m - 1.0f;
  real t = d / (m + 1.0f);
  real q = t * t;
  real p = TRI_RATIO(1, 15) + q * (TRI_RATIO(1, 17) + q * TRI_RATIO(1, 19));
  p = TRI_RATIO(1, 7) + q * (TRI_RATIO(1, 9) + q * (TRI_RATIO(1, 11) + q * (TRI_RATIO(1, 13) + q * p)));
  p = 1.0f + q * (TRI_RATIO(1, 3) + q * (TRI_RATIO(1, 5) + q * p));
  return TRI_TO_REAL(e) + TRI_2_OVER_LN2 * t * p;
}

// Returns 1 − 2^z, computed as in the single-precision version below, with an error of 5u in addition to the error
// of z. With x = (z − n)·ln 2 and |x| ≤ ½·ln 2, truncating the series after x¹³ causes an error below
// 1.1·x¹³/14! < 1.4e-17 = 0.2u. The remaining error consists of one and a half roundings in x (half a rounding is
// in the constant), one in the outermost sum, and one in its product with x. The roundings of nested sums are
// multiplied by at most x/2.
TRI_FN real tri_1m_exp2(real z) {
  real c = z > -1022.0f ? z : TRI_TO_REAL(0 - 1022);
  real n = TRI_FLOOR(c + 0.5f);
  real x = (c - n) * TRI_LN2;
  real w = TRI_RATIO(1, 11) * x * (1.0f + TRI_RATIO(1, 12) * x * (1.0f + TRI_RATIO(1, 13) * x));
  w = TRI_RATIO(1, 8) * x * (1.0f + TRI_RATIO(1, 9) * x * (1.0f + TRI_RATIO(1, 10) * x * (1.0f + w)));
  w = TRI_RATIO(1, 5) * x * (1.0f + TRI_RATIO(1, 6) * x * (1.0f + TRI_RATIO(1, 7) * x * (1.0f + w)));
  w = x * (1.0f + 0.5f * x * (1.0f + TRI_RATIO(1, 3) * x * (1.0f + 0.25f * x * (1.0f + w))));
  real scale = TRI_WITH_HIGH_WORD(TRI_TO_REAL(0), (TRI_INT(n) + 1023) * 1048576);
  return (1.0f - scale) - scale * w;
}

#else

// Returns log2(1 − alpha) for alpha in [0, 1), without cancellation for small alpha. It uses
// log(m) = 2·atanh((m−1)/(m+1)) for m in [√½, √2). If the exponent e is 0, m − 1 is exactly −alpha. Truncating the
// series after t⁹ causes a relative error below 3e-10. With a correctly rounded division, the total error is below
// 5.2u, as tested for every float. A division with an error of 2.5 ulp, which the languages allow, would add 4u.
TRI_FN float tri_log2_1m(float alpha) {
  float y = 1.0f - alpha;
  int bits = TRI_AS_INT(y);
  int e = ((bits - 0x3f3504f3) >> 23);  // 0x3f3504f3 are the bits of √½
  float m = TRI_AS_FLOAT(bits - e * 8388608);
  float d = e == 0 ? 0.0f - alpha : m - 1.0f;
  float t = d / (m + 1.0f);
  float q = t * t;
  float p = 2.8853900818f + q * (0.9617966939f + q * (0.5770780164f + q * (0.4121985831f + q * 0.3205988980f)));
  return TRI_TO_FLOAT(e) + t * p;
}

// Returns 1 − 2^z for z ≤ 0, without cancellation for small |z|. With n = round(z), 2^z = 2^n·(1 + w) and
// 1 − 2^z = (1 − 2^n) − 2^n·w, where w = 2^(z−n) − 1 is computed by a series to degree 7 (relative error below
// 2e-9). The total error is below 2.3u, as tested for every float.
TRI_FN float tri_1m_exp2(float z) {
  float c = z > -126.0f ? z : -126.0f;
  float n = TRI_FLOOR(c + 0.5f);
  float f = c - n;
  float w = f * (0.6931471806f + f * (0.2402265070f + f * (0.0555041087f + f * (0.0096181291f +
            f * (0.0013333558f + f * (0.0001540353f + f * 0.0000152527f))))));
  float scale = TRI_AS_FLOAT((TRI_INT(n) + 127) * 8388608);
  return (1.0f - scale) - scale * w;
}

#endif

// Returns the opacity of `steps` voxel lengths if one voxel length has the opacity alpha: 1 − (1 − alpha)^steps. It
// is exact for alpha = 0 and alpha = 1 (steps > 0). The relative error in double precision is below 12u: 6u from
// the logarithm, u from the product and 5u from the exponential. In single precision it is below 8u, because an
// error in z is multiplied by κ(z) = |z|·ln 2·2^z/(1 − 2^z) ≤ 1, and the sum of 6.2u·κ(z) and the exponential's own
// error at z is below 7.97u, as tested for every float z.
TRI_FN real tri_opacity(real alpha, real steps) {
  if (!(alpha > 0.0f) || !(steps > 0.0f)) return TRI_TO_REAL(0);
  if (alpha >= 1.0f) return TRI_TO_REAL(1);
  return tri_1m_exp2(steps * tri_log2_1m(alpha));
}

// Returns 1 − (1 − alpha)^steps. If `steps` is one of the powers of two from ⅛ to 4, `form` encodes it: form = k > 0
// means steps = 2^(1−k), and form = k < 0 means steps = 2^−k. For any other `steps`, `form` is 0. alpha is in [0, 1],
// and the result is exact at both ends. For k > 1, n = k − 1 square roots are used: with r_0 = 1 − alpha and
// r_i = √r_(i−1), the result is 1 − r_n = alpha / ((1 + r_1)…(1 + r_n)), which involves no cancellation. Each square
// root adds 1.5 roundings, and the division adds one. For k < 0, a → a·(2 − a) is applied repeatedly, with two
// roundings each time.
TRI_FN real tri_opacity_by_form(real alpha, real steps, int form) {
  if (form == 0) return tri_opacity(alpha, steps);
  real root = 1.0f - alpha;
  real divisor = 1.0f;
  for (int k = 1; k < form; ++k) {
    root = TRI_SQRT(root);
    divisor = divisor * (1.0f + root);
  }
  real result = form > 1 ? alpha / divisor : alpha;
  for (int k = 0; k < 0 - form; ++k) result = result * (2.0f - result);
  return result;
}
