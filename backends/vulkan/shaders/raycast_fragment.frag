#version 450
#extension GL_GOOGLE_include_directive : require
#include "prelude.glsl"
#include "portable/prelude.glsl"
#include "portable/volume_math.h"
#include "portable/volume_preintegration.h"
#include "volume/raycast/parameters.glsl"
#if TRI_CELLS
#include "volume/raycast/raycast_cells.glsl"
#else
#include "volume/raycast/preintegrated.glsl"
#include "volume/raycast/raycast.glsl"
#endif

layout(location = 0) out vec4 colour;

void main() { colour = raycast(ivec2(gl_FragCoord.xy)); }
