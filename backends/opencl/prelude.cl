// Makes volume_math.h valid OpenCL C. The preludes for GLSL and C++ are in src/technique/portable/.

// Disables fused multiply-add: a·b+c is rounded twice, as on every other backend.
#pragma OPENCL FP_CONTRACT OFF

#if TRI_PRECISION == 64
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double real;
typedef double2 real2;
typedef double3 real3;
typedef double4 real4;
#define TRI_REAL2(v) convert_double2(v)
#define TRI_REAL3(v) convert_double3(v)
#define TRI_REAL4(v) convert_double4(v)
// Table entries and pixels are floats in either precision.
#define TRI_ENTRY(v) convert_double4(v)
#define TRI_FLOAT4(v) convert_float4(v)
#define TRI_HIGH_WORD(x) ((int)(as_long(x) >> 32))
#define TRI_WITH_HIGH_WORD(x, word) as_double(((long)(word) << 32) | (as_long(x) & 0xffffffffL))
#define TRI_LN2 0.69314718055994530942
#define TRI_2_OVER_LN2 2.8853900817779268147
#else
typedef float real;
typedef float2 real2;
typedef float3 real3;
typedef float4 real4;
#define TRI_REAL2(v) convert_float2(v)
#define TRI_REAL3(v) convert_float3(v)
#define TRI_REAL4(v) convert_float4(v)
#define TRI_ENTRY(v) (v)
#define TRI_FLOAT4(v) (v)
#endif

// Functions are always inlined. PoCL's compiler inlines nothing by itself, and a call in a loop
// would prevent it from vectorising the loop.
#define TRI_FN static inline __attribute__((always_inline))
#define TRI_FLOAT2 float2
#define TRI_MAKE_FLOAT2(x, y) ((float2)((x), (y)))
#define TRI_AS_INT(x) as_int(x)
#define TRI_AS_FLOAT(x) as_float(x)
#define TRI_FLOOR(x) tri_floor(x)
#define TRI_CEIL(x) tri_ceil(x)
#define TRI_SQRT(x) sqrt(x)
#define TRI_INT(x) ((int)(x))
#define TRI_TO_FLOAT(x) ((float)(x))
#define TRI_TO_REAL(x) ((real)(x))
#define TRI_MAKE_REAL2(x, y) ((real2)((x), (y)))
#define TRI_RATIO(a, b) ((real)(a) / (real)(b))
#define TRI_PRECISE

// Defined for |x| < 2³¹. Uses conversions, because floor() and ceil() are calls in PoCL.
TRI_FN real tri_floor(real x) {
  real whole = (real)(int)x;
  return whole > x ? whole - 1.0f : whole;
}
TRI_FN real tri_ceil(real x) {
  real whole = (real)(int)x;
  return whole < x ? whole + 1.0f : whole;
}
