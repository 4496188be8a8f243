#include "technique/particles/particle_counts.hpp"

#include <algorithm>
#include <vector>

namespace triptych::technique {

std::uint64_t visible_ids(const core::Image& image) {
  std::vector<std::uint32_t> ids = image.ids;
  std::ranges::sort(ids);
  const auto repeated = std::ranges::unique(ids);
  ids.erase(repeated.begin(), repeated.end());
  return ids.size() - (!ids.empty() && ids.back() == core::Image::no_particle ? 1 : 0);
}

std::map<std::string, std::uint64_t> particle_counts(const CountedFrame& frame,
                                                     std::span<const std::uint32_t> sums,
                                                     const core::Image& image) {
  const auto sum = [&](ParticleCounter which) {
    std::uint64_t result = 0;
    for (auto at = static_cast<std::size_t>(which); at < sums.size();
         at += particle_counter_columns) {
      result += sums[at];
    }
    return result;
  };
  if (frame.method == Method::rays) {
    return {{"nodes_visited", sum(ParticleCounter::nodes_visited)},
            {"boxes_tested", sum(ParticleCounter::boxes_tested)},
            {"intersections_tested", sum(ParticleCounter::intersections_tested)},
            {"visible_ids", visible_ids(image)}};
  }
  const bool all = frame.culling == Culling::none;
  const std::uint64_t submitted = all ? frame.particles : sum(ParticleCounter::submitted);
  std::map<std::string, std::uint64_t> counts{
      {"cells", frame.cells},
      {"cells_culled", all ? 0 : sum(ParticleCounter::cells_culled)},
      {"particles_submitted", submitted},
      {"particles_culled", frame.particles - submitted},
      {"sprites", sum(ParticleCounter::sprites)},
      {"vertices", sum(ParticleCounter::vertices)},
      {"visible_ids", visible_ids(image)}};
  if (frame.method == Method::tiles) {
    counts["bin_entries"] = sum(ParticleCounter::bin_entries);
  } else {
    const std::uint64_t fragments = sum(ParticleCounter::fragments);
    const std::uint64_t discarded = sum(ParticleCounter::discarded);
    counts["fragments"] = fragments;
    counts["fragments_discarded"] = discarded;
    counts["fragments_kept"] = fragments - discarded;
  }
  return counts;
}

}  // namespace triptych::technique
