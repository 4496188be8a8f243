#version 450
#extension GL_GOOGLE_include_directive : require
#define TRI_VERTEX gl_VertexIndex
#include "anchors/anchor_raster.vert.glsl"
