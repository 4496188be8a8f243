#version 450
#extension GL_GOOGLE_include_directive : require
#include "particle_prelude.glsl"
#include "tiles_prelude.glsl"
#include "particles/camera_space.glsl"
#include "particles/sprite.glsl"
#include "particles/cells.glsl"
#include "particles/keys.glsl"
#include "particles/tile_grid.glsl"
#include "particles/tiles.glsl"
#include "particles/tiles_cells.comp.glsl"
