#include "backends/opencl/kernel_code.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "measure/code/compiled_code.hpp"
#include "measure/code/printed_kernels.hpp"

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

// Returns the figures that every OpenCL driver reports for a kernel, in bytes or work items.
std::map<std::string, double> work_group_info(const Session& session, const cl::Kernel& kernel) {
  const auto number = [](auto value) { return static_cast<double>(value); };
  const cl::Device& device = session.device;
  return {
      {"Private memory", number(kernel.getWorkGroupInfo<CL_KERNEL_PRIVATE_MEM_SIZE>(device))},
      {"Local memory", number(kernel.getWorkGroupInfo<CL_KERNEL_LOCAL_MEM_SIZE>(device))},
      {"Work group size", number(kernel.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(device))},
      {"Preferred multiple",
       number(kernel.getWorkGroupInfo<CL_KERNEL_PREFERRED_WORK_GROUP_SIZE_MULTIPLE>(device))},
  };
}

// Parses NVIDIA's build log with -cl-nv-verbose: "… Used 32 registers, 8 bytes stack frame, …".
// Logs of other drivers add nothing.
void add_logged(const std::string& log, const std::string& kernel,
                std::map<std::string, double>& statistics) {
  const std::size_t at = log.find("'" + kernel + "'");
  if (at == std::string::npos) return;
  const std::size_t used = log.find("Used ", at);
  if (used == std::string::npos) return;
  for (const auto& [name, value] :
       measure::parse_counts(log.substr(at, log.find('\n', used) - at))) {
    statistics[name] = value;
  }
}

}  // namespace

measure::Compiled code_of(const Session& session, const std::vector<CapturedProgram>& programs) {
  measure::CompiledCode code;
  for (const auto& [program, printed] : programs) {
    const std::string log = program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(session.device);
    std::multimap<std::string, measure::PrintedKernel> compiled;
    for (measure::PrintedKernel& kernel : measure::parse_printed_kernels(printed)) {
      compiled.emplace(kernel.name.substr(0, kernel.name.find(' ')), std::move(kernel));
    }
    for (const std::string& name : kernels_of(program)) {
      std::map<std::string, double> info =
          work_group_info(session, cl::Kernel(program, name.c_str()));
      add_logged(log, name, info);
      const auto [first, last] = compiled.equal_range(name);
      if (first == last) code.add(name, std::move(info), {});
      for (auto each = first; each != last; ++each) {
        measure::PrintedKernel& kernel = each->second;
        kernel.statistics.insert(info.begin(), info.end());
        code.add(kernel.name, std::move(kernel.statistics), std::move(kernel.assembly));
      }
    }
  }
  return code.take();
}

}  // namespace triptych::opencl_backend
