#version 450
#extension GL_GOOGLE_include_directive : require
#include "particle_prelude.glsl"
#include "particles/camera_space.glsl"
#define TRI_INSTANCE gl_InstanceIndex
#define TRI_CORNER gl_VertexIndex
#include "particles/keys.glsl"
#include "particles/tile_grid.glsl"
#include "particles/tiles_show.vert.glsl"
