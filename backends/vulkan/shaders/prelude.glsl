// Makes the shared GLSL valid for Vulkan: one descriptor set, and compile-time constants as
// specialization constants (pipeline.hpp: Constants). TRI_COUNT is not a specialization constant.
// It is defined when the SPIR-V is built, so that the timed build contains no code for counting.
#define TRI_BINDING(n) layout(set = 0, binding = n)
layout(constant_id = 0) const int TRI_MANUAL_SAMPLER = 1;
layout(constant_id = 1) const int TRI_SHADING = 0;
layout(constant_id = 2) const int TRI_SPEED_OF_LIGHT = 0;
layout(constant_id = 3) const int TRI_FAULT = 0;
layout(constant_id = 4) const int opacity_form = 0;
#define TRI_OPACITY_FORM opacity_form
layout(constant_id = 5) const int TRI_PREINTEGRATED = 0;
layout(constant_id = 6) const int TRI_LEAPS = 0;
layout(constant_id = 7) const int TRI_ADAPT = 0;
layout(constant_id = 8) const int TRI_VOXEL_BITS = 32;
