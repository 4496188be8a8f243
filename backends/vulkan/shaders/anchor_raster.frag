#version 450
#extension GL_GOOGLE_include_directive : require
#include "anchors/anchor_raster.frag.glsl"
