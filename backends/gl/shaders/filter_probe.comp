// Samples a volume at given positions with the device's filter, as raycast.glsl does.
layout(local_size_x = 64) in;
layout(binding = 1) uniform sampler3D volume;
layout(std430, binding = 4) buffer Probe { vec4 probe[]; };  // xyz: position in voxels; w: the value found

void main() {
  uint index = gl_GlobalInvocationID.x;
  vec3 size = vec3(textureSize(volume, 0));
  probe[index].w = textureLod(volume, probe[index].xyz / size, 0.0).r;
}
