#version 450
// Samples a volume at given positions in voxels, as fetch_hardware in raycast.glsl does.
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform sampler3D volume_texture;
// xyz: position; w: sampled value
layout(std430, set = 0, binding = 1) buffer Samples { vec4 samples[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  vec3 size = vec3(textureSize(volume_texture, 0));
  if (i < samples.length()) samples[i].w = textureLod(volume_texture, samples[i].xyz / size, 0.0).r;
}
