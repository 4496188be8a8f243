// Kernels of the feature probes (features.cpp).

// Each work group writes its own number plus 1.
__kernel void write_groups(__global uint* numbers) {
  uint group = get_group_id(0) + get_num_groups(0) * (get_group_id(1) + get_num_groups(1) * get_group_id(2));
  numbers[group] = group + 1;
}

// Writes first + factor·i to element `begin` + i.
__kernel void write_line(__global uint* numbers, ulong begin, uint first, uint factor) {
  ulong i = get_global_id(0);
  numbers[begin + i] = first + factor * (uint)i;
}

// Writes each global id to its own element. Global ids begin with the offset of the launch.
__kernel void write_numbers(__global uint* numbers) { numbers[get_global_id(0)] = (uint)get_global_id(0); }

// Adds in the storage type, so that sums wrap around.
__kernel void add_bytes(__global uchar* bytes) {
  size_t i = get_global_id(0);
  bytes[i] = (uchar)(bytes[i] + (uchar)i);
}
__kernel void add_shorts(__global ushort* shorts) {
  size_t i = get_global_id(0);
  shorts[i] = (ushort)(shorts[i] + (ushort)(3 * i));
}

// Samples a square image with `edge` texels per side, at coordinates from -1 to 3 (in units of the
// image size).
#define SAMPLE(name, mode)                                                                              \
  __constant sampler_t name##_sampler = CLK_NORMALIZED_COORDS_TRUE | mode | CLK_FILTER_NEAREST;          \
  __kernel void name(__read_only image2d_t texels, __global float* values, int edge) {                  \
    int i = (int)get_global_id(0);                                                                      \
    float2 place = (float2)((float)(i % (4 * edge)), (float)(i / (4 * edge))) + 0.5f - (float)edge;      \
    values[i] = read_imagef(texels, name##_sampler, place / (float)edge).x;                             \
  }
SAMPLE(sample_repeat, CLK_ADDRESS_REPEAT)
SAMPLE(sample_mirrored, CLK_ADDRESS_MIRRORED_REPEAT)
SAMPLE(sample_border, CLK_ADDRESS_CLAMP)

// Reads the second row of an image.
__constant sampler_t exact_sampler = CLK_NORMALIZED_COORDS_FALSE | CLK_ADDRESS_CLAMP_TO_EDGE | CLK_FILTER_NEAREST;
__kernel void fetch_row(__read_only image2d_t texels, __global float* values) {
  int i = (int)get_global_id(0);
  values[i] = read_imagef(texels, exact_sampler, (int2)(i, 1)).x;
}
