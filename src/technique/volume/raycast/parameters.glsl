// The layout is the same as that of technique::RaycastParameters (raycast_parameters.hpp), which explains each
// field. The backend's prelude defines TRI_BINDING(n) and the compile-time constants
//   TRI_MANUAL_SAMPLER, TRI_SHADING, TRI_SPEED_OF_LIGHT, TRI_FAULT, TRI_PREINTEGRATED
//   (technique::preintegration_form), TRI_LEAPS, TRI_ADAPT, TRI_VOXEL_BITS (technique::voxel_bits),
// which may be specialization constants, and the macros TRI_PRECISION (bits of a `real`: 32 or 64), TRI_COUNT (0 or
// 1), TRI_LONG_RAYS (0 or 1: technique::has_long_rays), TRI_PACKED (0 or 1: technique::Sampler::packed) and
// TRI_PARTS (0 or 1: technique::Part). It may also define the macro TRI_OPACITY_FORM, which is
// technique::opacity_form of the step.
#ifndef TRI_OPACITY_FORM
#define TRI_OPACITY_FORM 0
#endif
layout(std140) TRI_BINDING(0) uniform Parameters {
  real4 eye;
  real4 ray_centre;
  real4 ray_right;
  real4 ray_up;
  real4 inverse_spacing;
  real4 value_map;
  real4 shading;
  real4 background;
  ivec4 volume_size;
  ivec4 brick_grid;
  ivec4 viewport;
#if TRI_PARTS
  ivec4 part;  // technique::PartParameters
  ivec4 pass;
#endif
} u;

// transfer_entry(i) reads one of the 256 entries. brick_at(i) is 1 for a visible brick and 0 for an invisible one.
// With TRI_LEAPS it is the brick's technique::brick_reach, and with TRI_ADAPT its technique::BrickKind.
// quadrature_entry(i) reads technique::quadrature_table. With TRI_PACKED all data are texels, because the devices
// for which sampler=packed is intended access storage buffers lane by lane, but texel buffers as vectors.
#if TRI_PACKED
TRI_BINDING(1) uniform usamplerBuffer cell_texels;  // technique::fill_packed_cells
TRI_BINDING(2) uniform samplerBuffer transfer_texels;
TRI_BINDING(3) uniform isamplerBuffer brick_texels;
TRI_BINDING(6) uniform samplerBuffer quadrature_texels;
vec4 transfer_entry(int i) { return texelFetch(transfer_texels, i); }
int brick_at(int i) { return texelFetch(brick_texels, i).r; }
vec4 quadrature_entry(int i) { return texelFetch(quadrature_texels, i); }
#else
TRI_BINDING(1) uniform sampler3D volume_texture;
TRI_BINDING(2) uniform sampler1D transfer_texture;
layout(std430) TRI_BINDING(3) readonly buffer Bricks { int brick_visible[]; };
layout(std430) TRI_BINDING(6) readonly buffer Quadrature { vec4 quadrature_table[]; };
vec4 transfer_entry(int i) { return texelFetch(transfer_texture, i, 0); }
int brick_at(int i) { return brick_visible[i]; }
vec4 quadrature_entry(int i) { return quadrature_table[i]; }
#endif
#if TRI_TRACE
#define TRI_COUNTERS buffer
#else
#define TRI_COUNTERS writeonly buffer
#endif
#if TRI_COUNT
layout(std430) TRI_BINDING(5) TRI_COUNTERS Counters { uint counters[]; };
#endif
