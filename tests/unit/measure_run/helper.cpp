// measure_run_helper worker DEVICE       serves the null backend's device with the fake suite
// measure_run_helper supervise STORE     runs the fake suite's quick plan on null:scripted, or
//                                        continues its latest run in the store
// measure_run_helper count LOOPS         counts an allocation and a loop with LOOPS iterations,
//                                        whose code is in memory without a file
// measure_run_helper count-busy LOOPS    does the same while another thread has much to do at first
// measure_run_helper count-stride BYTES  counts instructions and cache misses of 1,000 loads with
//                                        this distance
// measure_run_helper keeps PID           exits with code 0 if this child is still alive after
//                                        another process was started and has ended
//
// Each counting command counts three times and prints one line for each time.
//
// TRIPTYCH_TEST_STARTS names a file to which each worker appends its process id.
// TRIPTYCH_TEST_FAILING_STARTS is the number of workers that exit at once with code 7.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "backends/null/backend.hpp"
#include "measure/counting/instruction_counter.hpp"
#include "measure/run/runner.hpp"
#include "measure/system/process.hpp"
#include "measure/worker/worker.hpp"
#include "tests/unit/measure/fake_suite.hpp"

namespace {

using namespace triptych;

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

int lines_in(const std::string& file) {
  std::ifstream lines(file);
  int count = 0;
  for (std::string line; std::getline(lines, line);) ++count;
  return count;
}

int serve(const std::string& device) {
  const std::string starts = variable("TRIPTYCH_TEST_STARTS");
  if (!starts.empty()) {
    std::ofstream(starts, std::ios::app) << ::getpid() << "\n";
    const std::string failing = variable("TRIPTYCH_TEST_FAILING_STARTS");
    if (!failing.empty() && lines_in(starts) <= std::stoi(failing)) return 7;
  }
  measure::FakeSuite suite;
  const auto backend = null_backend::make_backend();
  const auto find = [&suite](std::string_view) -> measure::Suite& { return suite; };
  return measure::serve_worker(*backend, device, find, measure::Process::child_request_fd,
                               measure::Process::child_answer_fd);
}

int supervise(const std::string& program, const std::string& file) {
  measure::FakeSuite suite;
  const auto find = [&suite](std::string_view) -> measure::Suite& { return suite; };
  record::Store store(file, record::Store::Mode::append);
  const measure::Plan plan = measure::load_plan("fake/quick", {}, find);
  measure::RunOptions options;
  options.worker_command = {program, "worker"};
  options.resume = true;
  try {
    static_cast<void>(measure::run_plan(plan, {"null:scripted"}, suite, store, options, {}));
  } catch (const measure::Interrupted& interrupt) {
    return 100 + interrupt.signal();
  }
  return 0;
}

// Copies machine code to executable memory, as a driver's compiler does.
template <typename Function>
Function* in_memory(std::span<const unsigned char> code) {
  void* memory = ::mmap(nullptr, code.size(), PROT_READ | PROT_WRITE | PROT_EXEC,
                        MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  std::memcpy(memory, code.data(), code.size());
  return reinterpret_cast<Function*>(memory);
}

// mov eax, LOOPS; again: sub eax, 1; jnz again; ret. These are 2·LOOPS + 2 instructions.
void (*loop_in_memory(std::uint32_t loops))() {
  std::array<unsigned char, 11> code{0xb8, 0, 0, 0, 0, 0x83, 0xe8, 0x01, 0x75, 0xfb, 0xc3};
  std::memcpy(&code[1], &loops, sizeof loops);
  return in_memory<void()>(code);
}

// Counts `act` three times, and prints the counts in one line each time.
template <typename Action>
void print_counts(const measure::InstructionCounter& counter, const std::vector<std::string>& names,
                  Action action) {
  for (int i = 0; i < 3; ++i) {
    record::Counts counts;
    static_cast<void>(counter.count(counts, [&] {
      action();
      return 0;
    }));
    std::vector<std::uint64_t> line;
    for (const std::string& name : names) line.push_back(counts.at(name));
    fmt::print("{}\n", fmt::join(line, " "));
  }
}

// mov ecx, 1000; again: mov rax, [rdi]; add rdi, STRIDE; sub ecx, 1; jnz again; ret
int count_stride(unsigned char stride) {
  const auto counter = measure::InstructionCounter::of_this_process();
  if (!counter) return 2;
  const std::array<unsigned char, 18> code{0xb9, 0xe8, 0x03,   0,    0,    0x48, 0x8b, 0x07, 0x48,
                                           0x83, 0xc7, stride, 0x83, 0xe9, 0x01, 0x75, 0xf4, 0xc3};
  const auto walk = in_memory<void(const void*)>(code);
  void* const data = ::mmap(nullptr, 1 << 17, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  print_counts(*counter, {"device_code", "misses"}, [&] { walk(data); });
  return 0;
}

// If `busy` is true, another thread is busy at first, like a driver thread that writes a cache.
int count_loop(std::uint32_t loops, bool busy) {
  const auto counter = measure::InstructionCounter::of_this_process();
  if (!counter) return 2;
  const auto loop = loop_in_memory(loops);
  std::jthread other;
  if (busy) other = std::jthread(loop_in_memory(30'000'000));
  counter->wait_until_quiet();
  print_counts(*counter, {"device_code", "driver", "allocations"}, [&] {
    loop();
    void* volatile memory = std::malloc(100);
    std::free(memory);
    // Lets the other threads run.
    if (busy) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  });
  return 0;
}

int child_survives(pid_t child) {
  measure::Process process({"/bin/true"}, {});
  const bool ended = process.wait(std::chrono::seconds(10)).has_value();
  return ended && ::kill(child, 0) == 0 ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return 64;
  const std::string_view part = arguments[1];
  if (part == "count" || part == "count-busy") {
    return count_loop(static_cast<std::uint32_t>(std::stoul(arguments[2])), part == "count-busy");
  }
  if (part == "count-stride") {
    return count_stride(static_cast<unsigned char>(std::stoul(arguments[2])));
  }
  if (part == "keeps") return child_survives(std::stoi(arguments[2]));
  return part == "worker" ? serve(arguments[2]) : supervise(arguments[0], arguments[2]);
}
