// measure_run_helper worker DEVICE       serves the null backend's device with the fake suite
// measure_run_helper supervise STORE     runs the fake suite's quick plan on null:scripted, or goes
//                                        on with its latest run there
//
// TRIPTYCH_TEST_STARTS names a file to which each worker appends its process id;
// TRIPTYCH_TEST_FAILING_STARTS says how many of the first workers leave at once with code 7.

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

#include "backends/null/backend.hpp"
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

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return 64;
  const std::string_view part = arguments[1];
  return part == "worker" ? work(arguments[2]) : supervise(arguments[0], arguments[2]);
}
