/* What the worker and its instruction counter (tool.c) agree on. Plain C, as the tool is. */
#ifndef TRIPTYCH_MEASURE_COUNTING_PROTOCOL_H
#define TRIPTYCH_MEASURE_COUNTING_PROTOCOL_H

/* Client requests (valgrind.h), from VG_USERREQ_TOOL_BASE('T', 'Y') on; each is answered by TRIPTYCH_COUNTS. */
enum {
  TRIPTYCH_TELL,    /* write the counts so far to the address of the first argument */
  TRIPTYCH_FUNCTION /* from now on count calls of the function at this address as allocations; at most eight */
};

/* The counts, in the order in which they are written: unsigned 64-bit numbers. */
enum {
  TRIPTYCH_DEVICE_CODE,
  TRIPTYCH_DRIVER,
  TRIPTYCH_LIBC,
  TRIPTYCH_PROGRAM,
  TRIPTYCH_ALLOCATIONS,
  TRIPTYCH_MISSES, /* of device code in a simulated cache of the first level */
  TRIPTYCH_COUNTS
};

#endif
