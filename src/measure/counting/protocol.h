/* What the worker and the instruction counter (plugin.c) agree on. Plain C: the plugin is. */
#ifndef TRIPTYCH_MEASURE_COUNTING_PROTOCOL_H
#define TRIPTYCH_MEASURE_COUNTING_PROTOCOL_H

/* The number of a system call that no kernel has, and its first argument. */
#define TRIPTYCH_MARK 4242
enum {
  TRIPTYCH_TELL = 1,           /* write the counts so far to the file descriptor of the second argument */
  TRIPTYCH_FUNCTION = 2,       /* count calls of the function at this address as allocations */
  TRIPTYCH_FUNCTIONS_DONE = 3  /* all functions are told */
};

/* The counts, in the order in which they are written: native unsigned 64-bit numbers. */
enum {
  TRIPTYCH_DEVICE_CODE,
  TRIPTYCH_DRIVER,
  TRIPTYCH_LIBC,
  TRIPTYCH_PROGRAM,
  TRIPTYCH_ALLOCATIONS,
  TRIPTYCH_COUNTS
};

#endif
