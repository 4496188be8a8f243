#version 450
#extension GL_GOOGLE_include_directive : require
#include "particle_prelude.glsl"
#include "particles/cells.glsl"
#include "particles/cull.glsl"
#include "particles/cull.comp.glsl"
