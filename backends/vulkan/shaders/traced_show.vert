#version 450
#extension GL_GOOGLE_include_directive : require
#include "particle_prelude.glsl"
#define TRI_CORNER gl_VertexIndex
#include "particles/traced_show.vert.glsl"
