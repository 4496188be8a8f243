#include "scene/file_content.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>

#include "core/file.hpp"
#include "scene/inflate.hpp"
#include "scene/progress_steps.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene {

std::vector<char> read_content(const std::filesystem::path& file, const Progress& progress) {
  const std::vector<std::byte> bytes = core::read_file(file);
  if (lower_case(file.extension().string()) != ".gz") {
    const auto* begin = reinterpret_cast<const char*>(bytes.data());
    return {begin, begin + bytes.size()};
  }
  constexpr std::size_t piece = std::size_t{1} << 20;
  // Small enough that the progress moves in steps of a hundredth.
  const std::size_t sip = std::max<std::size_t>(bytes.size() / 200, 1);
  ProgressSteps steps(progress, bytes.size());
  std::size_t taken = 0;
  Inflater inflater(
      [&](std::span<std::byte> out) {
        const std::size_t size = std::min({out.size(), bytes.size() - taken, sip});
        if (size > 0) std::memcpy(out.data(), bytes.data() + taken, size);
        taken += size;
        steps.reach(taken);
        return size;
      },
      file.string());
  std::vector<char> content;
  for (;;) {
    const std::size_t before = content.size();
    content.resize(before + piece);
    const std::size_t got =
        inflater.read(std::as_writable_bytes(std::span(content).subspan(before)));
    content.resize(before + got);
    if (got < piece) return content;
  }
}

}  // namespace triptych::scene
