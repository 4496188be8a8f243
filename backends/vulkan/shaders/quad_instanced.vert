#version 450
#extension GL_GOOGLE_include_directive : require
#include "particle_prelude.glsl"
#include "particles/camera_space.glsl"
#include "particles/colour.glsl"
#include "particles/storage.glsl"
#include "particles/sprite.glsl"
#define TRI_PARTICLE gl_InstanceIndex
#define TRI_CORNER gl_VertexIndex
#include "particles/quad_instanced.vert.glsl"
