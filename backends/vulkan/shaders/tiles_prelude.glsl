// The declarations that the passes of `tiles` need in addition to particle_prelude.glsl.
layout(push_constant) uniform Round { uvec2 cells; } round_of;
#define TRI_ROUND round_of.cells
layout(constant_id = 7) const int TRI_CULLING = 1;
layout(constant_id = 8) const int TRI_SPHERES = 7;
