#version 450
// Samples a square image with `edge` texels per side, at coordinates from -1 to 3 (in units of the
// image size).
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform sampler2D texels;
layout(std430, set = 0, binding = 1) writeonly buffer Values { float values[]; };
layout(push_constant) uniform Push { uint edge; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  uint side = 4u * edge;
  vec2 place = vec2(float(i % side), float(i / side)) + 0.5 - float(edge);
  values[i] = textureLod(texels, place / float(edge), 0.0).r;
}
