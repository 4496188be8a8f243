// The texel buffers that traced_show.frag.glsl reads. Include this before storage.glsl.
TRI_BINDING(16) uniform usamplerBuffer pixel_texels;  // two planes, as in traced.glsl
TRI_BINDING(17) uniform samplerBuffer sphere_texels;
TRI_BINDING(18) uniform usamplerBuffer colour_texels;  // 1 or 4 words per particle
TRI_BINDING(19) uniform usamplerBuffer id_texels;
#define TRI_COLOUR_WORD(n) texelFetch(colour_texels, int(n)).x
