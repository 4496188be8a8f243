#version 450
#extension GL_GOOGLE_include_directive : require
#include "particle_prelude.glsl"
#include "hierarchy_prelude.glsl"
#include "particles/hierarchy_scatter.comp.glsl"
