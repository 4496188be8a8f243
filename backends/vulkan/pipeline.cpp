#include "backends/vulkan/pipeline.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstring>
#include <stdexcept>
#include <vector>

#include "core/hash.hpp"
#include "measure/contract/dump.hpp"
#include "triptych_backend_vulkan_embedded.hpp"

namespace triptych::vulkan_backend {

std::string_view spirv(std::string_view name) {
  const std::string_view code = embedded(name);
  if (code.empty()) throw std::out_of_range(fmt::format("no embedded shader {}", name));
  return code;
}

std::string shader_name(std::string_view code) {
  for (const std::string_view name : embedded_names()) {
    if (embedded(name).data() != code.data()) continue;
    return std::string(name.substr(0, name.rfind(".spv")));
  }
  return "shader";
}

vk::raii::ShaderModule make_shader(const Gpu& gpu, std::string_view code) {
  std::vector<std::uint32_t> words(code.size() /
                                   sizeof(std::uint32_t));  // aligned, as Vulkan requires
  std::memcpy(words.data(), code.data(), code.size());
  return {gpu.device, vk::ShaderModuleCreateInfo{.codeSize = code.size(), .pCode = words.data()}};
}

vk::SpecializationInfo Specialization::info() const {
  return {.mapEntryCount = static_cast<std::uint32_t>(entries_.size()),
          .pMapEntries = entries_.data(),
          .dataSize = words_.size() * sizeof(std::int32_t),
          .pData = words_.data()};
}

vk::Pipeline compute_pipeline(const Gpu& gpu, const Layout& layout, std::string_view code,
                              const Specialization& constants) {
  const std::string key =
      fmt::format("{}; {}", code_hash({&code, 1}, constants), layout.definition);
  const StageNames stages{{vk::ShaderStageFlagBits::eCompute, shader_name(code)}};
  return gpu.pipelines->get(key, stages, [&](vk::PipelineCreateFlags flags) -> vk::raii::Pipeline {
    const vk::SpecializationInfo specialization = constants.info();
    const vk::raii::ShaderModule module = make_shader(gpu, code);
    const auto begin = std::chrono::steady_clock::now();
    vk::raii::Pipeline pipeline(
        gpu.device, nullptr,
        vk::ComputePipelineCreateInfo{.flags = flags,
                                      .stage = {.stage = vk::ShaderStageFlagBits::eCompute,
                                                .module = *module,
                                                .pName = "main",
                                                .pSpecializationInfo = &specialization},
                                      .layout = *layout.pipeline});
    dump_shader(vk::ShaderStageFlagBits::eCompute, code, constants, begin);
    return pipeline;
  });
}

void dump_shader(vk::ShaderStageFlagBits stage, std::string_view code,
                 const Specialization& constants, std::chrono::steady_clock::time_point begin) {
  if (!measure::dump_folder()) return;
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
  measure::write_dump(
      vk::to_string(stage), "spv", code,
      fmt::format("entry point main, specialization constants 0 to {}: {}; the pipeline was "
                  "compiled in {:.1f} ms",
                  constants.words().size() - 1, fmt::join(constants.words(), " "), took.count()));
}

std::string code_hash(std::string_view code, const Constants& constants) {
  std::string text(code);
  text += fmt::format(
      "manual_sampler={} shading={} speed_of_light={} fault={} opacity_form={} "
      "preintegrated={} leaps={} adapt={}",
      constants.manual_sampler, constants.shading, constants.speed_of_light, constants.fault,
      constants.opacity_form, constants.preintegrated, constants.leaps, constants.adapt);
  return core::content_hash(text);
}

std::string code_hash(std::span<const std::string_view> codes, const Specialization& constants) {
  std::string text;
  for (const std::string_view code : codes) text += code;
  text += fmt::format("{}", fmt::join(constants.words(), " "));
  return core::content_hash(text);
}

}  // namespace triptych::vulkan_backend
