#include "scene/file_content.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>

#include "core/file.hpp"
#include "scene/inflate.hpp"
#include "scene/progress_steps.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene {

namespace {

// Calls `take` with each piece of what the gzip stream holds.
template <typename Take>
void unpack(const std::vector<std::byte>& packed, const std::string& name, ProgressSteps& steps,
            Take&& take) {
  // Small enough that the progress moves in steps of a hundredth.
  const std::size_t sip = std::max<std::size_t>(packed.size() / 200, 1);
  std::size_t taken = 0;
  Inflater inflater(
      [&](std::span<std::byte> out) {
        const std::size_t size = std::min({out.size(), packed.size() - taken, sip});
        if (size > 0) std::memcpy(out.data(), packed.data() + taken, size);
        taken += size;
        steps.reach(taken);
        return size;
      },
      name);
  std::vector<std::byte> piece(std::size_t{1} << 20);
  for (;;) {
    const std::size_t got = inflater.read(piece);
    take(std::span<const std::byte>(piece).first(got));
    if (got < piece.size()) return;
  }
}

// The stream is read twice: what it holds is counted before memory is taken for it.
std::uint64_t count_unpacked(const std::vector<std::byte>& packed, const std::string& name,
                             ProgressSteps& steps, std::uint64_t most) {
  std::uint64_t count = 0;
  unpack(packed, name, steps, [&](std::span<const std::byte> piece) {
    count += piece.size();
    if (count > most) refuse_unpacked(name, most);
  });
  return count;
}

}  // namespace

std::vector<char> read_content(const std::filesystem::path& file, const Progress& progress,
                               std::uint64_t most) {
  const std::vector<std::byte> bytes = core::read_file(file);
  if (lower_case(file.extension().string()) != ".gz") {
    const auto* begin = reinterpret_cast<const char*>(bytes.data());
    return {begin, begin + bytes.size()};
  }
  const std::string name = file.string();
  ProgressSteps counting(progress, bytes.size(), 0, 0.5);
  std::vector<char> content;
  content.reserve(count_unpacked(bytes, name, counting, most));
  ProgressSteps steps(progress, bytes.size(), 0.5, 1);
  unpack(bytes, name, steps, [&](std::span<const std::byte> piece) {
    const auto* begin = reinterpret_cast<const char*>(piece.data());
    content.insert(content.end(), begin, begin + piece.size());
  });
  return content;
}

}  // namespace triptych::scene
