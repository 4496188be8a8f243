// Makes the shared particle GLSL valid for Vulkan: one descriptor set, and compile-time constants as specialization
// constants (particle_data.hpp: ParticleConstants). TRI_COUNT, TRI_DEPTH_PROMISE and the macros that select shapes
// are set when the SPIR-V is built.
#define TRI_BINDING(n) layout(set = 0, binding = n)
#define TRI_LINK(n) layout(location = n)
layout(constant_id = 0) const int TRI_COLOUR = 0;
layout(constant_id = 1) const int TRI_TRANSFER_AT_PIXEL = 0;
layout(constant_id = 2) const int TRI_RAY_AT_VERTEX = 0;
layout(constant_id = 3) const int TRI_FAULT = 0;
layout(constant_id = 4) const float TRI_LARGEST_POINT = 1.0;
layout(constant_id = 5) const float TRI_POINT_MARGIN = 0.0;
layout(constant_id = 6) const float TRI_SPRITE_GROWTH = 0.0;
#include "portable/prelude.glsl"
#include "portable/volume_math.h"
#include "portable/sphere_math.h"
#include "particles/parameters.glsl"
