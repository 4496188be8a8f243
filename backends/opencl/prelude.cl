// What volume_math.h needs to be OpenCL C; GLSL and C++ have their own preludes in
// src/technique/portable/.

// a·b+c is rounded twice, as on every other backend.
#pragma OPENCL FP_CONTRACT OFF

// A call in a loop keeps PoCL's compiler from vectorising it, and it inlines nothing unless told.
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
#define TRI_PRECISE

// For |x| < 2³¹, by conversions: PoCL's floor() and ceil() are calls.
TRI_FN float tri_floor(float x) {
  float whole = (float)(int)x;
  return whole > x ? whole - 1.0f : whole;
}
TRI_FN float tri_ceil(float x) {
  float whole = (float)(int)x;
  return whole < x ? whole + 1.0f : whole;
}
