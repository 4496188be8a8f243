// measure_run_helper worker DEVICE       serves the null backend's device with the fake suite
// measure_run_helper supervise STORE     runs the fake suite's quick plan on null:scripted, or goes
//                                        on with its latest run there
// measure_run_helper count LOOPS         three times: what a loop in memory without a file takes
// that
//                                        often, and one allocation; a line of counts each
//
// TRIPTYCH_TEST_STARTS names a file to which each worker appends its process id;
// TRIPTYCH_TEST_FAILING_STARTS says how many of the first workers leave at once with code 7.

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>

#include "backends/null/backend.hpp"
#include "measure/counting/instruction_counter.hpp"
#include "measure/process.hpp"
#include "measure/runner.hpp"
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

int work(const std::string& device) {
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

// mov eax, LOOPS; again: sub eax, 1; jnz again; ret — 2·LOOPS + 2 instructions, as a driver's
// compiler would leave them in memory.
void (*loop_in_memory(std::uint32_t loops))() {
  std::array<unsigned char, 11> code{0xb8, 0, 0, 0, 0, 0x83, 0xe8, 0x01, 0x75, 0xfb, 0xc3};
  std::memcpy(&code[1], &loops, sizeof loops);
  void* memory = ::mmap(nullptr, code.size(), PROT_READ | PROT_WRITE | PROT_EXEC,
                        MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  std::memcpy(memory, code.data(), code.size());
  return reinterpret_cast<void (*)()>(memory);
}

int count_loop(std::uint32_t loops) {
  const auto counter = measure::InstructionCounter::of_this_process();
  if (!counter) return 2;
  const auto loop = loop_in_memory(loops);
  for (int i = 0; i < 3; ++i) {
    record::Counts counts;
    static_cast<void>(counter->counting(counts, [&] {
      loop();
      void* volatile memory = std::malloc(100);
      std::free(memory);
      return 0;
    }));
    fmt::print("{} {} {}\n", counts.at("device_code"), counts.at("driver"),
               counts.at("allocations"));
  }
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return 64;
  const std::string_view part = arguments[1];
  if (part == "count") return count_loop(static_cast<std::uint32_t>(std::stoul(arguments[2])));
  return part == "worker" ? work(arguments[2]) : supervise(arguments[0], arguments[2]);
}
