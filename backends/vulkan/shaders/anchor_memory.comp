#version 450
#extension GL_GOOGLE_include_directive : require
#define TRI_BINDING(n) layout(set = 0, binding = n)
#include "anchors/anchor_memory.comp.glsl"
