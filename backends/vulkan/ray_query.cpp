// Traces rays through the device's acceleration structure with ray queries in a compute kernel
// (technique/particles/ray_query.comp.glsl).
#include "backends/vulkan/structure_tracer.hpp"
#include "backends/vulkan/techniques.hpp"

namespace triptych::vulkan_backend {
namespace {

constexpr std::string_view timed_queries = "ray_query.comp.spv";
constexpr std::string_view counting_queries = "ray_query_counting.comp.spv";
constexpr std::uint32_t query_group_edge = 8;

class RayQueryTracer final : public StructureTracer {
 public:
  using StructureTracer::StructureTracer;

  void prepare_counting(const Layout& layout) override {
    counting_ = compute_pipeline(gpu_, layout, spirv(counting_queries), constants_);
  }
  [[nodiscard]] std::vector<std::string_view> codes() const override {
    return {spirv(timed_queries), SphereStructure::code()};
  }

 private:
  void prepare_rays(const Layout& layout) override {
    timed_ = compute_pipeline(gpu_, layout, spirv(timed_queries), constants_);
  }
  void trace_rays(const vk::raii::CommandBuffer& commands, const Layout& layout, bool counting,
                  std::uint32_t every_row) const override {
    const auto groups = [](std::uint32_t pixels) {
      return (pixels + query_group_edge - 1) / query_group_edge;
    };
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, counting ? counting_ : timed_);
    commands.pushConstants<std::int32_t>(*layout.pipeline, stages(), 0,
                                         static_cast<std::int32_t>(every_row));
    commands.dispatch(groups(width_), groups((height_ + every_row - 1) / every_row), 1);
  }

  vk::Pipeline timed_;
  vk::Pipeline counting_;
};

std::unique_ptr<Tracer> make_query_tracer(const Gpu& gpu, const measure::ParticleWork& work,
                                          const technique::Arrangement& /*arrangement*/,
                                          const ParticleData& data) {
  return std::make_unique<RayQueryTracer>(gpu, work, data);
}

}  // namespace

std::unique_ptr<measure::Prepared> prepare_ray_query(const Gpu& gpu, const Instance& instance,
                                                     const measure::ParticleWork& work) {
  return prepare_traced(gpu, instance, work, &make_query_tracer);
}

}  // namespace triptych::vulkan_backend
