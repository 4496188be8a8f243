// Declares storage buffers with the particles, for techniques without a vertex buffer. A shader that fetches colours
// in a different way defines TRI_COLOUR_WORD(n) before it includes this file, which then declares no buffers.
#ifndef TRI_COLOUR_WORD
layout(std430) TRI_BINDING(3) readonly buffer Spheres { vec4 spheres[]; };
layout(std430) TRI_BINDING(4) readonly buffer Colours { uint colour_words[]; };  // 1 or 4 words per particle
layout(std430) TRI_BINDING(5) readonly buffer Ids { uint ids[]; };
#define TRI_COLOUR_WORD(n) colour_words[n]
#endif

vec4 stored_colour(uint particle) {
  if (TRI_COLOUR == 0) {
    uint word = TRI_COLOUR_WORD(particle);
    return vec4(uvec4(word, word >> 8, word >> 16, word >> 24) & 255u) * 0.0039215686274509803;
  }
  if (TRI_COLOUR == 1) {
    uint first = 4u * particle;
    return uintBitsToFloat(uvec4(TRI_COLOUR_WORD(first), TRI_COLOUR_WORD(first + 1u),
                                 TRI_COLOUR_WORD(first + 2u), TRI_COLOUR_WORD(first + 3u)));
  }
  return vec4(uintBitsToFloat(TRI_COLOUR_WORD(particle)), 0.0, 0.0, 1.0);
}
