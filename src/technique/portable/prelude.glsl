// Defines the macros that make volume_math.h and the other .h files of this folder valid GLSL. The prelude for
// OpenCL C is in backends/opencl/, and the one for C++ is prelude.hpp.
#ifndef TRI_PRECISION
#define TRI_PRECISION 32
#endif
#if TRI_PRECISION == 64
#define real double
#define real2 dvec2
#define real3 dvec3
#define real4 dvec4
#define TRI_HIGH_WORD(value) int(unpackDouble2x32(value).y)
#define TRI_WITH_HIGH_WORD(value, word) packDouble2x32(uvec2(unpackDouble2x32(value).x, uint(word)))
#define TRI_LN2 0.69314718055994530942lf
#define TRI_2_OVER_LN2 2.8853900817779268147lf
#else
#define real float
#define real2 vec2
#define real3 vec3
#define real4 vec4
#endif
#define TRI_FN
#define TRI_FLOAT2 vec2
#define TRI_MAKE_FLOAT2(x, y) vec2(x, y)
#define TRI_AS_INT(x) floatBitsToInt(x)
#define TRI_AS_FLOAT(x) intBitsToFloat(x)
#define TRI_FLOOR(x) floor(x)
#define TRI_CEIL(x) ceil(x)
#define TRI_SQRT(x) sqrt(x)
#define TRI_INT(x) int(x)
#define TRI_TO_FLOAT(x) float(x)
#define TRI_TO_REAL(x) real(x)
#define TRI_MAKE_REAL2(x, y) real2(x, y)
// Compilers evaluate this constant expression to the nearest double.
#define TRI_RATIO(a, b) (real(a) / real(b))
// `precise` becomes the SPIR-V decoration NoContraction, so a·b+c is rounded twice, as on every other
// backend.
#define TRI_PRECISE precise
