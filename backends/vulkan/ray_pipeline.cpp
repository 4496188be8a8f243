// Traces rays through the device's acceleration structure with a ray tracing pipeline: ray
// generation, intersection, any hit, closest hit and miss (technique/particles/ray_pipeline.*).
#include <array>
#include <cstring>
#include <optional>

#include "backends/vulkan/structure_tracer.hpp"
#include "backends/vulkan/techniques.hpp"

namespace triptych::vulkan_backend {
namespace {

struct RayStage {
  vk::ShaderStageFlagBits stage;
  std::string_view timed;
  std::string_view counting;
};
using enum vk::ShaderStageFlagBits;
constexpr std::array<RayStage, 5> ray_stages{
    {{eRaygenKHR, "ray_pipeline.rgen.spv", "ray_pipeline_counting.rgen.spv"},
     {eMissKHR, "ray_pipeline.rmiss.spv", "ray_pipeline_counting.rmiss.spv"},
     {eIntersectionKHR, "ray_pipeline.rint.spv", "ray_pipeline_counting.rint.spv"},
     {eAnyHitKHR, "ray_pipeline.rahit.spv", "ray_pipeline_counting.rahit.spv"},
     {eClosestHitKHR, "ray_pipeline.rchit.spv", "ray_pipeline_counting.rchit.spv"}}};

// The shader groups of the pipeline. Each has one record in the shader binding table.
enum RayGroup : std::uint8_t { raygen_group, miss_group, hit_group, ray_groups };

vk::raii::Pipeline make_ray_pipeline(const Gpu& gpu, const Layout& layout,
                                     const Specialization& constants, bool counting) {
  const vk::SpecializationInfo specialization = constants.info();
  std::vector<vk::raii::ShaderModule> modules;
  std::vector<vk::PipelineShaderStageCreateInfo> stages;
  for (const RayStage& each : ray_stages) {
    modules.push_back(make_shader(gpu, spirv(counting ? each.counting : each.timed)));
    stages.push_back({.stage = each.stage,
                      .module = *modules.back(),
                      .pName = "main",
                      .pSpecializationInfo = &specialization});
  }
  constexpr std::uint32_t none = VK_SHADER_UNUSED_KHR;
  const auto general = [](std::uint32_t stage) {
    return vk::RayTracingShaderGroupCreateInfoKHR{
        .type = vk::RayTracingShaderGroupTypeKHR::eGeneral,
        .generalShader = stage,
        .closestHitShader = none,
        .anyHitShader = none,
        .intersectionShader = none};
  };
  const std::array<vk::RayTracingShaderGroupCreateInfoKHR, ray_groups> all{
      general(0), general(1),
      vk::RayTracingShaderGroupCreateInfoKHR{
          .type = vk::RayTracingShaderGroupTypeKHR::eProceduralHitGroup,
          .generalShader = none,
          .closestHitShader = 4,
          .anyHitShader = 3,
          .intersectionShader = 2}};
  return {
      gpu.device, nullptr, nullptr,
      vk::RayTracingPipelineCreateInfoKHR{.stageCount = static_cast<std::uint32_t>(stages.size()),
                                          .pStages = stages.data(),
                                          .groupCount = static_cast<std::uint32_t>(all.size()),
                                          .pGroups = all.data(),
                                          .maxPipelineRayRecursionDepth = 1,
                                          .layout = *layout.pipeline}};
}

// A pipeline with its shader binding table. The table has one record per group, with the alignment
// that the device requires.
class RayPipeline {
 public:
  RayPipeline(const Gpu& gpu, const Layout& layout, const Specialization& constants, bool counting)
      : pipeline_(make_ray_pipeline(gpu, layout, constants, counting)),
        stride_((gpu.extensions.group_handle_bytes + gpu.extensions.group_base_alignment - 1) /
                gpu.extensions.group_base_alignment * gpu.extensions.group_base_alignment),
        table_(make_table(gpu)),
        address_(gpu.device.getBufferAddressKHR({.buffer = table_.get()})) {}

  void trace(const vk::raii::CommandBuffer& commands, std::uint32_t width,
             std::uint32_t height) const {
    const vk::DeviceSize alignment = stride_;
    const vk::DeviceAddress begin = (address_ + alignment - 1) / alignment * alignment;
    const auto region = [&](RayGroup group) {
      return vk::StridedDeviceAddressRegionKHR{
          .deviceAddress = begin + group * alignment, .stride = alignment, .size = alignment};
    };
    commands.bindPipeline(vk::PipelineBindPoint::eRayTracingKHR, *pipeline_);
    commands.traceRaysKHR(region(raygen_group), region(miss_group), region(hit_group), {}, width,
                          height, 1);
  }

 private:
  [[nodiscard]] Buffer make_table(const Gpu& gpu) const {
    const std::uint32_t bytes = gpu.extensions.group_handle_bytes;
    const std::vector<std::uint8_t> handles =
        pipeline_.getRayTracingShaderGroupHandlesKHR<std::uint8_t>(0, ray_groups,
                                                                   std::size_t{ray_groups} * bytes);
    Buffer table(gpu, vk::DeviceSize{stride_} * (ray_groups + 1),
                 vk::BufferUsageFlagBits::eShaderBindingTableKHR |
                     vk::BufferUsageFlagBits::eShaderDeviceAddress,
                 Place::upload);
    const vk::DeviceAddress at = gpu.device.getBufferAddressKHR({.buffer = table.get()});
    const std::size_t begin = static_cast<std::size_t>((stride_ - at % stride_) % stride_);
    for (std::size_t group = 0; group < ray_groups; ++group) {
      std::memcpy(table.mapped().data() + begin + group * stride_, handles.data() + group * bytes,
                  bytes);
    }
    return table;
  }

  vk::raii::Pipeline pipeline_;
  std::uint32_t stride_;
  Buffer table_;
  vk::DeviceAddress address_;
};

class RayPipelineTracer final : public StructureTracer {
 public:
  using StructureTracer::StructureTracer;

  [[nodiscard]] vk::ShaderStageFlags stages() const override {
    return eCompute | eRaygenKHR | eIntersectionKHR | eAnyHitKHR | eClosestHitKHR | eMissKHR;
  }
  // No pipeline statistic counts rays.
  [[nodiscard]] vk::QueryPipelineStatisticFlags statistics() const override { return {}; }
  void prepare_counting(const Layout& layout) override {
    counting_.emplace(gpu_, layout, constants_, true);
  }
  [[nodiscard]] std::vector<std::string_view> codes() const override {
    std::vector<std::string_view> codes{SphereStructure::code()};
    for (const RayStage& each : ray_stages) codes.push_back(spirv(each.timed));
    return codes;
  }

 private:
  void prepare_rays(const Layout& layout) override {
    timed_.emplace(gpu_, layout, constants_, false);
  }
  void trace_rays(const vk::raii::CommandBuffer& commands, const Layout& layout, bool counting,
                  std::uint32_t every_row) const override {
    commands.pushConstants<std::int32_t>(*layout.pipeline, stages(), 0,
                                         static_cast<std::int32_t>(every_row));
    (counting ? *counting_ : *timed_)
        .trace(commands, width_, (height_ + every_row - 1) / every_row);
  }

  std::optional<RayPipeline> timed_;
  std::optional<RayPipeline> counting_;
};

std::unique_ptr<Tracer> make_pipeline_tracer(const Gpu& gpu, const measure::ParticleWork& work,
                                             const technique::Arrangement& /*arrangement*/,
                                             const ParticleData& data) {
  return std::make_unique<RayPipelineTracer>(gpu, work, data);
}

}  // namespace

std::unique_ptr<measure::Prepared> prepare_ray_pipeline(const Gpu& gpu, const Instance& instance,
                                                        const measure::ParticleWork& work) {
  return prepare_traced(gpu, instance, work, &make_pipeline_tracer);
}

}  // namespace triptych::vulkan_backend
