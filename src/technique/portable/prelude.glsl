// What volume_math.h needs to be GLSL. OpenCL C has its own prelude in backends/opencl/, C++ in prelude.hpp.
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
// NoContraction: a·b+c is rounded twice, as on every other backend.
#define TRI_PRECISE precise
