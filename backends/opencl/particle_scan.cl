// Computes where the entries of each bin begin, from the number of entries in each bin. A bin is a
// tile or a coarse tile, and its entries are the particles that overlap it (particle_bins.cl).

// Runs one work item per bin. Replaces counts by positions within the bin, and writes the length of
// the bin to totals[bin].
__kernel void place_chunks(uint bins, uint chunks, __global uint* restrict counts,
                           __global uint* restrict totals, __global uint* restrict counters) {
  uint bin = (uint)get_global_id(0);
  if (bin >= bins) return;
  uint sum = 0;
  for (uint chunk = 0; chunk < chunks; ++chunk) {
    __global uint* count = counts + (size_t)bins * chunk + bin;
    uint here = *count;
    *count = sum;
    sum += here;
  }
  totals[bin] = sum;
#if TRI_COUNT
  counters[8 * bin + TRI_COUNT_BIN_ENTRIES] += sum;
#endif
}

// Runs one work group. begins[bin] is the position where the entries of a bin begin, and
// begins[bins] is the number of entries. The first work item processes the last range of bins, so
// that it needs the results of all other work items. Therefore a missing barrier is detected even
// if work items run one after another.
__kernel void place_bins(uint bins, __global const uint* restrict totals,
                         __global uint* restrict begins) {
  __local uint sums[TRI_SCAN_ITEMS];
  uint item = TRI_SCAN_ITEMS - 1 - (uint)get_local_id(0);
  uint stretch = (bins + TRI_SCAN_ITEMS - 1) / TRI_SCAN_ITEMS;
  uint from = min(item * stretch, bins);
  uint to = min(from + stretch, bins);
#if TRI_MISSING_BARRIER
  // Results of the previous frame must not hide a missing barrier.
  if (item == TRI_SCAN_ITEMS - 1) {
    for (uint other = 0; other < item; ++other) sums[other] = 0;
  }
#endif
  uint sum = 0;
  for (uint bin = from; bin < to; ++bin) sum += totals[bin];
  sums[item] = sum;
#if !TRI_MISSING_BARRIER
  barrier(CLK_LOCAL_MEM_FENCE);
#endif
  uint place = 0;
  for (uint other = 0; other < item; ++other) place += sums[other];
  for (uint bin = from; bin < to; ++bin) {
    begins[bin] = place;
    place += totals[bin];
  }
  if (item == TRI_SCAN_ITEMS - 1) begins[bins] = place;
}
