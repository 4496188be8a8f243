#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_query : require
#include "particle_prelude.glsl"
layout(push_constant) uniform Rows { int every_row; } rows;
#define TRI_EVERY_ROW rows.every_row
#include "particles/camera_space.glsl"
#include "particles/keys.glsl"
#include "particles/traced.glsl"
#include "particles/nearest_hit.glsl"
#include "particles/ray_query.comp.glsl"
