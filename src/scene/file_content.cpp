#include "scene/file_content.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>

#include "core/error.hpp"
#include "core/file.hpp"
#include "scene/compression.hpp"
#include "scene/inflate.hpp"
#include "scene/progress_steps.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene {

namespace {

// Calls `consume` with each piece of the decompressed stream.
template <typename Take>
void unpack(const std::vector<std::byte>& packed, Packing packing, const std::string& name,
            ProgressSteps& steps, Take&& consume) {
  // The input is read in small pieces, so that progress is reported at least once for each per cent
  // of the input.
  const std::size_t most_at_once = std::max<std::size_t>(packed.size() / 200, 1);
  std::size_t consumed = 0;
  const ByteSource source = unpacked(
      [&](std::span<std::byte> out) {
        const std::size_t size = std::min({out.size(), packed.size() - consumed, most_at_once});
        if (size > 0) std::memcpy(out.data(), packed.data() + consumed, size);
        consumed += size;
        steps.advance_to(consumed);
        return size;
      },
      packing, name);
  std::vector<std::byte> piece(std::size_t{1} << 20);
  for (;;) {
    const std::size_t got = source(piece);
    consume(std::span<const std::byte>(piece).first(got));
    if (got < piece.size()) return;
  }
}

// Returns the decompressed size. The stream is decompressed twice: this first pass determines the
// size, so that memory needs to be allocated only once.
std::uint64_t count_unpacked(const std::vector<std::byte>& packed, Packing packing,
                             const std::string& name, ProgressSteps& steps, std::uint64_t most) {
  std::uint64_t count = 0;
  unpack(packed, packing, name, steps, [&](std::span<const std::byte> piece) {
    count += piece.size();
    if (count > most) refuse_unpacked(name, most);
  });
  return count;
}

}  // namespace

std::vector<char> read_content(const std::filesystem::path& file, const Progress& progress,
                               std::uint64_t most) {
  const std::vector<std::byte> bytes = core::read_file(file);
  const std::string name = file.string();
  const Packing packing = packing_of(bytes, name);
  const bool has_gzip_extension = lower_case(file.extension().string()) == ".gz";
  if (has_gzip_extension && packing == Packing::none) {
    throw core::InputError(
        {.file = name},
        "the name ends in .gz, but the content is not a gzip stream; if the file "
        "is not compressed, remove .gz from its name");
  }
  if (packing == Packing::none) {
    const auto* begin = reinterpret_cast<const char*>(bytes.data());
    return {begin, begin + bytes.size()};
  }
  ProgressSteps counting(progress, bytes.size(), 0, 0.5);
  std::vector<char> content;
  content.reserve(count_unpacked(bytes, packing, name, counting, most));
  ProgressSteps steps(progress, bytes.size(), 0.5, 1);
  unpack(bytes, packing, name, steps, [&](std::span<const std::byte> piece) {
    const auto* begin = reinterpret_cast<const char*>(piece.data());
    content.insert(content.end(), begin, begin + piece.size());
  });
  return content;
}

}  // namespace triptych::scene
