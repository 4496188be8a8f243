// Reads the second row of an image.
layout(local_size_x = 64) in;
layout(binding = 0) uniform sampler2D texels;
layout(std430, binding = 0) writeonly buffer Values { float values[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  values[i] = texelFetch(texels, ivec2(int(i), 1), 0).r;
}
