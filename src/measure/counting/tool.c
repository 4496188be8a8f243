/* The instruction counter: a Valgrind tool under which the worker runs. It is linked from the libraries in Debian's
 * Valgrind package. It counts the executed instructions, grouped by the location of their code:
 *   device_code  memory that is not mapped from a file (code that a driver generates at run time), and the files of a
 *                driver's kernel cache, whose paths contain the value of --device-files
 *   libc         the C library, the loader, the C++ runtime and compression libraries. Their counts depend on the layout
 *                of the heap and on whether a cache is written.
 *   program      the counted program itself, whose path is the value of --program
 *   driver       all other libraries
 * It also counts the calls of up to eight functions, such as malloc, whose addresses the worker sends. The loads and
 * stores of device code pass through a simulated cache, whose misses are counted, because an unfavourable memory access
 * pattern takes time but no additional instructions.
 *
 * Valgrind runs only one thread at a time, so one set of counters is sufficient. The worker controls the tool by client
 * requests (protocol.h). */
#include "pub_tool_basics.h"
#include "pub_tool_aspacemgr.h"
#include "pub_tool_libcassert.h"
#include "pub_tool_libcbase.h"
#include "pub_tool_machine.h"
#include "pub_tool_options.h"
#include "pub_tool_tooliface.h"
#include "pub_tool_transtab.h"
#include "valgrind.h"

#include "measure/counting/protocol.h"

enum { most_functions = 8, page_bits = 12 };

static ULong counts[TRIPTYCH_COUNTS];
static Addr function_at[most_functions];
static UInt function_count;
static const HChar* device_part = "";
static const HChar* program = "";

static Bool is_of_the_runtime(const HChar* name) {
  static const HChar* const runtime[] = {"libc",     "ld-linux-x86-64", "libpthread", "libstdc++",
                                         "libgcc_s", "libzstd",         "libz",       "liblzma"};
  for (UInt i = 0; i < sizeof runtime / sizeof *runtime; ++i) {
    const SizeT length = VG_(strlen)(runtime[i]);
    if (VG_(strncmp)(name, runtime[i], length) != 0) continue;
    if (name[length] == '.' || name[length] == '-' || name[length] == '\0') return True;
  }
  return False;
}

static UInt owner_at(Addr address) {
  const NSegment* segment = VG_(am_find_nsegment)(address);
  const HChar* path = segment != NULL ? VG_(am_get_filename)(segment) : NULL;
  if (path == NULL || path[0] != '/') return TRIPTYCH_DEVICE_CODE;
  if (device_part[0] != '\0' && VG_(strstr)(path, device_part) != NULL) return TRIPTYCH_DEVICE_CODE;
  if (VG_(strcmp)(path, program) == 0) return TRIPTYCH_PROGRAM;
  return is_of_the_runtime(VG_(strrchr)(path, '/') + 1) ? TRIPTYCH_LIBC : TRIPTYCH_DRIVER;
}

/* Adds code to the end of a translated block, which computes counts[which] += amount. The code does not call a function,
 * because a call would take longer than the rest of the block. */
static void add(IRSB* block, UInt which, UInt amount) {
  if (amount == 0) return;
  IRExpr* const place = mkIRExpr_HWord((HWord)&counts[which]);
  const IRTemp before = newIRTemp(block->tyenv, Ity_I64);
  const IRTemp after = newIRTemp(block->tyenv, Ity_I64);
  addStmtToIRSB(block, IRStmt_WrTmp(before, IRExpr_Load(Iend_LE, Ity_I64, place)));
  addStmtToIRSB(block, IRStmt_WrTmp(after, IRExpr_Binop(Iop_Add64, IRExpr_RdTmp(before),
                                                        IRExpr_Const(IRConst_U64(amount)))));
  addStmtToIRSB(block, IRStmt_Store(Iend_LE, place, IRExpr_RdTmp(after)));
}

/* A first-level data cache of 32 KiB with lines of 64 bytes, which replaces the least recently used line. It is fully
 * associative: in a set-associative cache, the number of misses would depend on the addresses of buffers, and would vary
 * by 16 % from run to run. */
enum { line_bits = 6, line_count = 512, bucket_count = 1024, nothing = line_count };
static struct {
  Addr number;
  UShort newer, older;    /* a ring in order of use; `nothing` is between the newest and the oldest line */
  UShort next_in_bucket;  /* `nothing` ends the list */
} lines[line_count + 1];
static UShort buckets[bucket_count];

static void put_into_bucket(UShort line, Addr number) {
  lines[line].number = number;
  lines[line].next_in_bucket = buckets[number % bucket_count];
  buckets[number % bucket_count] = line;
}

static void take_out_of_bucket(UShort line) {
  UShort* place = &buckets[lines[line].number % bucket_count];
  while (*place != line) place = &lines[*place].next_in_bucket;
  *place = lines[line].next_in_bucket;
}

static void put_behind(UShort newer, UShort line) {
  const UShort older = lines[newer].older;
  lines[line].newer = newer;
  lines[line].older = older;
  lines[newer].older = line;
  lines[older].newer = line;
}

static void make_cache(void) {
  for (UInt i = 0; i < bucket_count; ++i) buckets[i] = nothing;
  lines[nothing].newer = lines[nothing].older = nothing;
  for (UShort i = 0; i < line_count; ++i) {
    put_into_bucket(i, ~(Addr)i); /* a number that no memory has */
    put_behind(nothing, i);
  }
}

static void touch_line(Addr number) {
  if (lines[lines[nothing].older].number == number) return;
  UShort line = buckets[number % bucket_count];
  while (line != nothing && lines[line].number != number) line = lines[line].next_in_bucket;
  if (line == nothing) {
    ++counts[TRIPTYCH_MISSES];
    line = lines[nothing].newer; /* the least recently used line */
    take_out_of_bucket(line);
    put_into_bucket(line, number);
  }
  lines[lines[line].newer].older = lines[line].older;
  lines[lines[line].older].newer = lines[line].newer;
  put_behind(nothing, line);
}

static VG_REGPARM(2) void touched(Addr address, SizeT size) {
  const Addr last = (address + size - 1) >> line_bits;
  for (Addr line = address >> line_bits; line <= last; ++line) touch_line(line);
}

/* Adds a call of touched() to the block. `guard` is the condition of a conditional access, or NULL for other accesses. */
static void touch(IRSB* block, IRExpr* address, Int size, IRExpr* guard) {
  IRDirty* const call = unsafeIRDirty_0_N(2, "touched", VG_(fnptr_to_fnentry)(touched),
                                          mkIRExprVec_2(address, mkIRExpr_HWord((HWord)size)));
  if (guard != NULL) call->guard = guard;
  addStmtToIRSB(block, IRStmt_Dirty(call));
}

static void touch_what(IRSB* block, const IRStmt* statement) {
  const IRTypeEnv* const types = block->tyenv;
  if (statement->tag == Ist_WrTmp && statement->Ist.WrTmp.data->tag == Iex_Load) {
    const IRExpr* const load = statement->Ist.WrTmp.data;
    touch(block, load->Iex.Load.addr, sizeofIRType(load->Iex.Load.ty), NULL);
  } else if (statement->tag == Ist_LoadG) {
    const IRLoadG* const load = statement->Ist.LoadG.details;
    IRType type = Ity_INVALID, widened = Ity_INVALID;
    typeOfIRLoadGOp(load->cvt, &widened, &type);
    touch(block, load->addr, sizeofIRType(type), load->guard);
  } else if (statement->tag == Ist_Store) {
    const IRType type = typeOfIRExpr(types, statement->Ist.Store.data);
    touch(block, statement->Ist.Store.addr, sizeofIRType(type), NULL);
  } else if (statement->tag == Ist_StoreG) {
    const IRStoreG* const store = statement->Ist.StoreG.details;
    touch(block, store->addr, sizeofIRType(typeOfIRExpr(types, store->data)), store->guard);
  } else if (statement->tag == Ist_CAS) {
    const IRCAS* const swap = statement->Ist.CAS.details;
    touch(block, swap->addr, sizeofIRType(typeOfIRExpr(types, swap->dataLo)), NULL);
  }
}

static Bool is_allocation(Addr address) {
  for (UInt i = 0; i < function_count; ++i) {
    if (function_at[i] == address) return True;
  }
  return False;
}

/* Valgrind calls this function for each block of code that it translates. Adds code that counts the executed instructions
 * of the block, before each exit from it. */
static IRSB* instrument(VgCallbackClosure* closure, IRSB* in, const VexGuestLayout* layout,
                        const VexGuestExtents* extents, const VexArchInfo* host, IRType guest_word,
                        IRType host_word) {
  (void)closure, (void)layout, (void)extents, (void)host, (void)guest_word, (void)host_word;
  IRSB* const out = deepCopyIRSBExceptStmts(in);
  UInt owner = TRIPTYCH_DRIVER;
  Addr page_of_owner = 0; /* the page of the latest instruction; all code on a page has the same owner */
  UInt pending = 0;
  for (Int i = 0; i < in->stmts_used; ++i) {
    IRStmt* const statement = in->stmts[i];
    if (statement == NULL || statement->tag == Ist_NoOp) continue;
    if (statement->tag == Ist_IMark) {
      const Addr address = statement->Ist.IMark.addr;
      const Addr page = address >> page_bits;
      const UInt its_owner = page == page_of_owner ? owner : owner_at(address);
      page_of_owner = page;
      if (its_owner != owner) {
        add(out, owner, pending);
        pending = 0;
        owner = its_owner;
      }
      ++pending;
      if (is_allocation(address)) add(out, TRIPTYCH_ALLOCATIONS, 1);
    } else if (statement->tag == Ist_Exit) {
      add(out, owner, pending);
      pending = 0;
    }
    if (owner == TRIPTYCH_DEVICE_CODE) touch_what(out, statement);
    addStmtToIRSB(out, statement);
  }
  add(out, owner, pending);
  return out;
}

static Bool requested(ThreadId thread, UWord* arguments, UWord* result) {
  (void)thread;
  if (!VG_IS_TOOL_USERREQ('T', 'Y', arguments[0])) return False;
  *result = TRIPTYCH_COUNTS;
  const UWord operation = arguments[0] - VG_USERREQ_TOOL_BASE('T', 'Y');
  if (operation == TRIPTYCH_READ_COUNTS) {
    VG_(memcpy)((void*)arguments[1], counts, sizeof counts);
  } else if (operation == TRIPTYCH_FUNCTION && function_count < most_functions) {
    function_at[function_count++] = arguments[1];
    VG_(discard_translations_safely)(arguments[1], 1, "triptych"); /* translate it again, with counting */
  }
  return True;
}

static Bool took_option(const HChar* argument) {
  if VG_STR_CLO(argument, "--device-files", device_part) {
  } else if VG_STR_CLO(argument, "--program", program) {
  } else {
    return False;
  }
  return True;
}

static void usage(void) {}
static void after_options(void) {}
static void at_end(Int code) { (void)code; }

static void before_options(void) {
  VG_(details_name)("triptych");
  VG_(details_version)(NULL);
  VG_(details_description)("counts a worker's instructions by the location of their code");
  VG_(details_copyright_author)("");
  VG_(details_bug_reports_to)("");
  VG_(basic_tool_funcs)(after_options, instrument, at_end);
  VG_(needs_client_requests)(requested);
  make_cache();
  VG_(needs_command_line_options)(took_option, usage, usage);
}

VG_DETERMINE_INTERFACE_VERSION(before_options)
