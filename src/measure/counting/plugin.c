// The instruction counter: a plugin of QEMU's user-mode emulator, loaded into the emulated worker.
//
// It adds up the instructions that every thread executes, by whose memory they lie in:
//   device_code  memory without a file (code that a driver writes at run time) and the files of a
//                driver's kernel cache, which the argument `device=TEXT` tells by a part of their path
//   libc         the C library, the loader, the C++ runtime and compression: what depends on how the
//                heap lies, or on whether a cache is written
//   program      the emulated program itself, which the argument `program=PATH` names
//   driver       every other library
// and counts the calls of up to eight functions (malloc and its kin) whose addresses it is told.
//
// The worker speaks to it by a system call that no kernel has: its number is MARK, its arguments an
// operation and one value. Without the plugin the call fails with ENOSYS and tells so.
//
// QEMU's package has no header for plugins, so what is used of their interface is declared here; the
// signatures are the same from API version 1 (QEMU 4.2) on. A plugin names the version that it is
// made for, and each emulator refuses some, hence TRIPTYCH_PLUGIN_API.

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "measure/counting/protocol.h"

#define EXPORT __attribute__((visibility("default")))

typedef uint64_t qemu_plugin_id_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
enum qemu_plugin_cb_flags { QEMU_PLUGIN_CB_NO_REGS, QEMU_PLUGIN_CB_R_REGS, QEMU_PLUGIN_CB_RW_REGS };

typedef void (*tb_translated_t)(qemu_plugin_id_t, struct qemu_plugin_tb*);
typedef void (*executed_t)(unsigned int vcpu, void* data);
typedef void (*syscall_t)(qemu_plugin_id_t, unsigned int vcpu, int64_t number, uint64_t a1, uint64_t a2,
                          uint64_t a3, uint64_t a4, uint64_t a5, uint64_t a6, uint64_t a7, uint64_t a8);
typedef void (*syscall_returned_t)(qemu_plugin_id_t, unsigned int vcpu, int64_t number, int64_t result);
typedef void (*simple_t)(qemu_plugin_id_t);

void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t, tb_translated_t);
void qemu_plugin_register_vcpu_tb_exec_cb(struct qemu_plugin_tb*, executed_t, enum qemu_plugin_cb_flags,
                                          void* data);
void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn*, executed_t, enum qemu_plugin_cb_flags,
                                            void* data);
void qemu_plugin_register_vcpu_syscall_cb(qemu_plugin_id_t, syscall_t);
void qemu_plugin_register_vcpu_syscall_ret_cb(qemu_plugin_id_t, syscall_returned_t);
void qemu_plugin_reset(qemu_plugin_id_t, simple_t);
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb*);
struct qemu_plugin_insn* qemu_plugin_tb_get_insn(const struct qemu_plugin_tb*, size_t);
uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn*);
void* qemu_plugin_insn_haddr(const struct qemu_plugin_insn*);

#ifndef TRIPTYCH_PLUGIN_API
#define TRIPTYCH_PLUGIN_API 1
#endif
EXPORT int qemu_plugin_version = TRIPTYCH_PLUGIN_API;

// --- counters: one set per thread, as threads run at once and an addition to a shared one could be lost

enum { most_threads = 4096, functions = 8 };

struct counters {
  uint64_t of[TRIPTYCH_COUNTS];
} __attribute__((aligned(64)));
static struct counters counters[most_threads];

struct block {
  uint32_t kind;
  uint32_t instructions;
};

static void block_executed(unsigned int vcpu, void* data) {
  const struct block* block = data;
  counters[vcpu % most_threads].of[block->kind] += block->instructions;
}

static void function_called(unsigned int vcpu, void* data) {
  (void)data;
  counters[vcpu % most_threads].of[TRIPTYCH_ALLOCATIONS] += 1;
}

// --- whose memory an address is

struct region {
  uint64_t begin, end;
  uint32_t kind;
};
static struct region* regions;
static size_t region_count, region_room;
static bool regions_stale = true;  // the program has mapped or unmapped since they were read
static char device_part[512];
static char program_path[4096];

static bool ends_a_name(char c) { return c == '.' || c == '-' || c == '\0'; }

static uint32_t kind_of(const char* path) {
  if (path[0] != '/') return TRIPTYCH_DEVICE_CODE;  // no file; also [heap], where no code lies
  if (device_part[0] != '\0' && strstr(path, device_part) != NULL) return TRIPTYCH_DEVICE_CODE;
  if (strcmp(path, program_path) == 0) return TRIPTYCH_PROGRAM;
  const char* name = strrchr(path, '/') + 1;
  static const char* const runtime[] = {"libc",    "ld-linux-x86-64", "libpthread", "libstdc++",
                                        "libgcc_s", "libzstd",         "libz",       "liblzma"};
  for (size_t i = 0; i < sizeof runtime / sizeof *runtime; ++i) {
    const size_t length = strlen(runtime[i]);
    if (strncmp(name, runtime[i], length) == 0 && ends_a_name(name[length])) return TRIPTYCH_LIBC;
  }
  return TRIPTYCH_DRIVER;
}

static void read_regions(void) {
  FILE* maps = fopen("/proc/self/maps", "r");
  if (maps == NULL) return;
  region_count = 0;
  char line[4608];
  while (fgets(line, sizeof line, maps) != NULL) {
    unsigned long begin = 0, end = 0;
    int path = 0;
    if (sscanf(line, "%lx-%lx %*s %*s %*s %*s %n", &begin, &end, &path) < 2) continue;
    line[strcspn(line, "\n")] = '\0';
    if (region_count == region_room) {
      region_room = region_room == 0 ? 1024 : 2 * region_room;
      regions = realloc(regions, region_room * sizeof *regions);
      if (regions == NULL) abort();
    }
    regions[region_count++] = (struct region){begin, end, kind_of(path > 0 ? line + path : "")};
  }
  fclose(maps);
  regions_stale = false;
}

static uint32_t kind_at(uint64_t address) {
  if (regions_stale) read_regions();
  size_t low = 0, high = region_count;
  while (low < high) {
    const size_t middle = low + (high - low) / 2;
    if (regions[middle].end <= address) low = middle + 1;
    else high = middle;
  }
  return low < region_count && regions[low].begin <= address ? regions[low].kind : TRIPTYCH_DEVICE_CODE;
}

// --- what QEMU calls

static uint64_t function_at[functions];
static size_t function_count;
static qemu_plugin_id_t own_id;

// QEMU translates under a lock of its own: nothing here runs twice at once.
static void block_translated(qemu_plugin_id_t id, struct qemu_plugin_tb* tb) {
  (void)id;
  const size_t count = qemu_plugin_tb_n_insns(tb);
  struct block* block = malloc(sizeof *block);  // as long as the translation may run: for ever
  if (block == NULL || count == 0) return;
  const struct qemu_plugin_insn* first = qemu_plugin_tb_get_insn(tb, 0);
  *block = (struct block){kind_at((uint64_t)(uintptr_t)qemu_plugin_insn_haddr(first)), (uint32_t)count};
  qemu_plugin_register_vcpu_tb_exec_cb(tb, block_executed, QEMU_PLUGIN_CB_NO_REGS, block);
  for (size_t i = 0; function_count > 0 && i < count; ++i) {
    struct qemu_plugin_insn* insn = qemu_plugin_tb_get_insn(tb, i);
    const uint64_t address = qemu_plugin_insn_vaddr(insn);
    for (size_t f = 0; f < function_count; ++f) {
      if (address != function_at[f]) continue;
      qemu_plugin_register_vcpu_insn_exec_cb(insn, function_called, QEMU_PLUGIN_CB_NO_REGS, NULL);
    }
  }
}

static void tell_counts(int fd) {
  struct counters sum = {{0}};
  for (size_t thread = 0; thread < most_threads; ++thread) {
    for (size_t i = 0; i < TRIPTYCH_COUNTS; ++i) sum.of[i] += counters[thread].of[i];
  }
  const ssize_t written = write(fd, sum.of, sizeof sum.of);
  (void)written;  // the reader sees what is missing
}

static void install(qemu_plugin_id_t id);

static void called(qemu_plugin_id_t id, unsigned int vcpu, int64_t number, uint64_t a1, uint64_t a2, uint64_t a3,
                   uint64_t a4, uint64_t a5, uint64_t a6, uint64_t a7, uint64_t a8) {
  (void)id, (void)vcpu, (void)a3, (void)a4, (void)a5, (void)a6, (void)a7, (void)a8;
  if (number != TRIPTYCH_MARK) return;
  if (a1 == TRIPTYCH_TELL) {
    tell_counts((int)a2);
  } else if (a1 == TRIPTYCH_FUNCTION && function_count < functions) {
    function_at[function_count++] = a2;
  } else if (a1 == TRIPTYCH_FUNCTIONS_DONE) {
    qemu_plugin_reset(own_id, install);  // translates anew, so that calls are seen
  }
}

static void returned(qemu_plugin_id_t id, unsigned int vcpu, int64_t number, int64_t result) {
  (void)id, (void)vcpu, (void)result;
  enum { mmap = 9, mprotect = 10, munmap = 11, mremap = 25, shmat = 30 };
  if (number == mmap || number == mprotect || number == munmap || number == mremap || number == shmat) {
    regions_stale = true;
  }
}

static void install(qemu_plugin_id_t id) {
  qemu_plugin_register_vcpu_tb_trans_cb(id, block_translated);
  qemu_plugin_register_vcpu_syscall_cb(id, called);
  qemu_plugin_register_vcpu_syscall_ret_cb(id, returned);
}

static void keep_argument(const char* argument, const char* name, char* out, size_t room) {
  const size_t length = strlen(name);
  if (strncmp(argument, name, length) == 0) snprintf(out, room, "%s", argument + length);
}

EXPORT int qemu_plugin_install(qemu_plugin_id_t id, const void* info, int count, char** arguments) {
  (void)info;
  own_id = id;
  for (int i = 0; i < count; ++i) {
    keep_argument(arguments[i], "device=", device_part, sizeof device_part);
    keep_argument(arguments[i], "program=", program_path, sizeof program_path);
  }
  install(id);
  return 0;
}
