#include "backends/opencl/kernel_code.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>

#include "measure/code/compiled_code.hpp"
#include "measure/code/standard_error.hpp"

namespace triptych::opencl_backend {
namespace {

std::vector<std::string> kernels_of(const cl::Program& program) {
  std::string names = program.getInfo<CL_PROGRAM_KERNEL_NAMES>();
  std::vector<std::string> kernels;
  while (!names.empty()) {
    const std::size_t end = names.find(';');
    std::string name = names.substr(0, end);
    name.erase(std::remove(name.begin(), name.end(), '\0'), name.end());
    if (!name.empty()) kernels.push_back(std::move(name));
    names.erase(0, end == std::string::npos ? names.size() : end + 1);
  }
  std::ranges::sort(kernels);
  return kernels;
}

// Values that every OpenCL driver reports, in bytes or work items.
std::map<std::string, double> work_group_info(const Session& session, const cl::Kernel& kernel) {
  const auto number = [](auto value) { return static_cast<double>(value); };
  const cl::Device& device = session.device;
  return {
      {"Private memory",
       number(kernel.getWorkGroupInfo<CL_KERNEL_PRIVATE_MEM_SIZE>(device))},
      {"Local memory", number(kernel.getWorkGroupInfo<CL_KERNEL_LOCAL_MEM_SIZE>(device))},
      {"Work group size", number(kernel.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(device))},
      {"Preferred multiple",
       number(kernel.getWorkGroupInfo<CL_KERNEL_PREFERRED_WORK_GROUP_SIZE_MULTIPLE>(device))},
  };
}

// The text between two lines that contain these words, for the last such pair of lines.
std::string between(std::string_view text, std::string_view start, std::string_view end) {
  const std::size_t at = text.rfind(start);
  if (at == std::string_view::npos) return {};
  const std::size_t first = text.find('\n', at);
  if (first == std::string_view::npos) return {};
  const std::size_t last = text.find(end, first);
  return std::string(text.substr(first + 1, last - first - 1));
}

// radeonsi prints a disassembly, and one statistic on each line.
void add_printed(std::string_view printed, std::map<std::string, double>& statistics,
                 std::string& assembly) {
  assembly = between(printed, "disassembly:", "*** SHADER");
  std::string lines = between(printed, "*** SHADER STATS ***", "****");
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    for (const auto& [name, value] : measure::parse_statistics(lines.substr(0, end))) {
      statistics[name] = value;
    }
    lines.erase(0, std::min(end + 1, lines.size()));
  }
}

// Parses NVIDIA's build log with -cl-nv-verbose: "… Used 32 registers, 8 bytes stack frame, …".
// Other logs have no such lines.
void add_logged(const std::string& log, const std::string& kernel,
                std::map<std::string, double>& statistics) {
  const std::size_t at = log.find("'" + kernel + "'");
  if (at == std::string::npos) return;
  const std::size_t used = log.find("Used ", at);
  if (used == std::string::npos) return;
  for (const auto& [name, value] : measure::parse_counts(log.substr(at, log.find('\n', used) - at))) {
    statistics[name] = value;
  }
}

}  // namespace

measure::Compiled code_of(const Session& session, const std::vector<cl::Program>& programs) {
  measure::CompiledCode code;
  for (const cl::Program& program : programs) {
    const std::string log = program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(session.device);
    const std::vector<std::string> kernels = kernels_of(program);
    for (const std::string& name : kernels) {
      cl::Kernel kernel;
      const std::string printed =
          measure::standard_error_of([&] { kernel = cl::Kernel(program, name.c_str()); });
      std::map<std::string, double> statistics = work_group_info(session, kernel);
      std::string assembly;
      add_printed(printed, statistics, assembly);
      add_logged(log, name, statistics);
      code.add(name, std::move(statistics), std::move(assembly));
    }
  }
  return code.take();
}

}  // namespace triptych::opencl_backend
