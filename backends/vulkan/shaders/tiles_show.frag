#version 450
#extension GL_GOOGLE_include_directive : require
#include "particle_prelude.glsl"
layout(constant_id = 8) const int TRI_SPHERES = 7;
#include "particles/camera_space.glsl"
#include "particles/colour.glsl"
#include "particles/keys.glsl"
#include "particles/tile_grid.glsl"
#include "particles/storage.glsl"
#include "particles/tiles_show.frag.glsl"
