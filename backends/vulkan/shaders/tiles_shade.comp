#version 450
#extension GL_GOOGLE_include_directive : require
#include "particle_prelude.glsl"
#include "particles/camera_space.glsl"
#include "particles/colour.glsl"
#include "particles/storage.glsl"
#include "particles/sprite.glsl"
#include "particles/tiles.glsl"
#include "particles/tiles_shade.comp.glsl"
