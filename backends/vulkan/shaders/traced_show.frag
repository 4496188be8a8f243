#version 450
#extension GL_GOOGLE_include_directive : require
#include "particle_prelude.glsl"
#include "particles/camera_space.glsl"
#include "particles/colour.glsl"
#include "particles/keys.glsl"
#include "particles/traced_texels.glsl"
#include "particles/storage.glsl"
#include "particles/traced_show.frag.glsl"
