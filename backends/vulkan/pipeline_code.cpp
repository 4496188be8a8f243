#include "backends/vulkan/pipeline_code.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "measure/code/compiled_code.hpp"

namespace triptych::vulkan_backend {
namespace {

double value_of(const vk::PipelineExecutableStatisticKHR& statistic) {
  switch (statistic.format) {
    case vk::PipelineExecutableStatisticFormatKHR::eBool32:
      return statistic.value.b32 == VK_TRUE ? 1 : 0;
    case vk::PipelineExecutableStatisticFormatKHR::eInt64:
      return static_cast<double>(statistic.value.i64);
    case vk::PipelineExecutableStatisticFormatKHR::eUint64:
      return static_cast<double>(statistic.value.u64);
    case vk::PipelineExecutableStatisticFormatKHR::eFloat64:
      break;
  }
  return statistic.value.f64;
}

std::map<std::string, double> statistics_of(const Gpu& gpu,
                                            const vk::PipelineExecutableInfoKHR& which) {
  std::map<std::string, double> statistics;
  for (const auto& each : gpu.device.getPipelineExecutableStatisticsKHR(which)) {
    statistics.emplace(each.name.data(), value_of(each));
  }
  return statistics;
}

// Returns whether a representation is the disassembly. Drivers also return code in intermediate
// languages, but only the name of the disassembly contains "assembly" or "SASS".
bool is_disassembly(const vk::PipelineExecutableInternalRepresentationKHR& each) {
  const std::string_view name = each.name.data();
  return each.isText == VK_TRUE && (name.find("ssembly") != std::string_view::npos ||
                                    name.find("SASS") != std::string_view::npos);
}

// Returns the disassembly of a pipeline executable, which is the code that the driver generated for
// one or more stages. The Vulkan function must be called twice: for the sizes, and then for the
// contents. Vulkan-Hpp makes only the first call.
std::string assembly_of(const Gpu& gpu, const vk::PipelineExecutableInfoKHR& which) {
  auto representations = gpu.device.getPipelineExecutableInternalRepresentationsKHR(which);
  std::vector<std::string> texts(representations.size());
  for (std::size_t i = 0; i < texts.size(); ++i) {
    texts[i].resize(representations[i].dataSize);
    representations[i].pData = texts[i].data();
  }
  auto count = static_cast<std::uint32_t>(representations.size());
  const auto result = static_cast<vk::Result>(
      gpu.device.getDispatcher()->vkGetPipelineExecutableInternalRepresentationsKHR(
          static_cast<VkDevice>(*gpu.device),
          reinterpret_cast<const VkPipelineExecutableInfoKHR*>(&which), &count,
          reinterpret_cast<VkPipelineExecutableInternalRepresentationKHR*>(
              representations.data())));
  if (result != vk::Result::eSuccess && result != vk::Result::eIncomplete) return {};
  std::string assembly;
  for (std::size_t i = 0; i < count; ++i) {
    if (is_disassembly(representations[i])) assembly = texts[i].c_str();  // up to the first NUL
  }
  return assembly;
}

// Returns the names of the shaders in an executable. If a driver merges stages, its first
// executable represents the whole pipeline.
std::string name_of(const Pipelines::Captured& captured,
                    const vk::PipelineExecutablePropertiesKHR& executable) {
  std::string name;
  for (const auto& [stage, shader] : captured.stages) {
    if (!(executable.stages & stage)) continue;
    name += (name.empty() ? "" : "+") + shader;
  }
  return name.empty() ? std::string(executable.name.data()) : name;
}

}  // namespace

measure::Compiled code_of(const Gpu& gpu, const std::vector<Pipelines::Captured>& pipelines) {
  measure::CompiledCode code;
  for (const Pipelines::Captured& captured : pipelines) {
    const auto executables = gpu.device.getPipelineExecutablePropertiesKHR(
        vk::PipelineInfoKHR{.pipeline = captured.pipeline});
    for (std::uint32_t i = 0; i < executables.size(); ++i) {
      const vk::PipelineExecutableInfoKHR which{.pipeline = captured.pipeline,
                                                .executableIndex = i};
      code.add(name_of(captured, executables[i]), statistics_of(gpu, which),
               assembly_of(gpu, which));
    }
  }
  return code.take();
}

}  // namespace triptych::vulkan_backend
