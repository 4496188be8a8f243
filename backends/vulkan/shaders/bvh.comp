#version 450
#extension GL_GOOGLE_include_directive : require
#include "particle_prelude.glsl"
#include "hierarchy_prelude.glsl"
#include "particles/camera_space.glsl"
#include "particles/keys.glsl"
#include "particles/sphere_box.glsl"
#include "particles/traced.glsl"
#include "particles/bvh.comp.glsl"
