// Samples the volume at places.xyz (in voxels), and writes the sampled value to places.w.
__kernel void filter_probe(__constant Parameters* u, TRI_VOLUME volume, __global float4* places) {
  int i = (int)get_global_id(0);
  Positions p;
  p.x[0] = places[i].x;
  p.y[0] = places[i].y;
  p.z[0] = places[i].z;
  float value[1];
  fetch(u, volume, &p, 1, value);
  places[i].w = value[0];
}
