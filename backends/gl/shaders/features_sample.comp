// Samples one mip level of a square image, at coordinates from -1 to 3 (in units of the image
// size).
layout(local_size_x = 64) in;
layout(binding = 0) uniform sampler2D texels;
layout(std430, binding = 0) writeonly buffer Values { float values[]; };
uniform uvec2 size;  // edge of the image, mip level

void main() {
  uint i = gl_GlobalInvocationID.x;
  uint side = 4u * size.x;
  vec2 place = vec2(float(i % side), float(i / side)) + 0.5 - float(size.x);
  values[i] = textureLod(texels, place / float(size.x), float(size.y)).r;
}
