/* The protocol between the worker and its instruction counter (tool.c). Plain C, because the tool is written in C. */
#ifndef TRIPTYCH_MEASURE_COUNTING_PROTOCOL_H
#define TRIPTYCH_MEASURE_COUNTING_PROTOCOL_H

/* Client requests (valgrind.h), numbered from VG_USERREQ_TOOL_BASE('T', 'Y'). The result of each is TRIPTYCH_COUNTS. */
enum {
  TRIPTYCH_READ_COUNTS, /* write the current counts to the address in the first argument */
  TRIPTYCH_FUNCTION     /* count calls of the function at this address as allocations from now on; at most eight functions */
};

/* The counts in the order in which they are written, as unsigned 64-bit numbers. */
enum {
  TRIPTYCH_DEVICE_CODE,
  TRIPTYCH_DRIVER,
  TRIPTYCH_LIBC,
  TRIPTYCH_PROGRAM,
  TRIPTYCH_ALLOCATIONS,
  TRIPTYCH_MISSES, /* cache misses of device code in a simulated first-level cache */
  TRIPTYCH_COUNTS
};

#endif
