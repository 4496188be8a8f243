#version 450
// Reads the second row of an image.
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform sampler2D texels;
layout(std430, set = 0, binding = 1) writeonly buffer Values { float values[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  values[i] = texelFetch(texels, ivec2(int(i), 1), 0).r;
}
