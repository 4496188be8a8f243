#version 450
#extension GL_GOOGLE_include_directive : require
#include "particle_prelude.glsl"
#include "portable/box_math.h"
#include "particles/storage.glsl"
#include "particles/sphere_box.glsl"
#include "particles/padded_box.glsl"
#define TRI_GROUP_COLUMNS 65535u
#include "particles/ray_boxes.comp.glsl"
