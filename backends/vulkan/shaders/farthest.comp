#version 450
#extension GL_GOOGLE_include_directive : require
#include "particle_prelude.glsl"
layout(std430) TRI_BINDING(11) readonly buffer Depths { float depths[]; };  // a copy of the depth image
#define TRI_DEPTH(pixel) depths[pixel.y * u.viewport.x + pixel.x]
#include "particles/farthest.comp.glsl"
