#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "scene/progress_steps.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene {

// The largest number of particles, because ids have 32 bits and the highest id means "none".
inline constexpr std::uint64_t most_particles = 0xFFFFFFFEU;

// Reads the lines of a text and counts them, so that errors can name the file and the line. The
// text must outlive the reader.
class LineReader {
 public:
  LineReader(std::string_view text, std::string file, ProgressSteps progress);

  // Returns the next line without its end (LF or CR LF), or nullopt after the last line.
  [[nodiscard]] std::optional<std::string_view> next();
  // Returns the next line. If there is none, throws InputError that the file ends where `what` was
  // expected.
  [[nodiscard]] std::string_view require(std::string_view what);
  // Skips blank lines; returns whether nothing else is left.
  [[nodiscard]] bool at_end();
  // Skips this many lines; all of them must exist.
  void skip(std::uint64_t count, std::string_view what);

  // Throws InputError that names the line that was read last, or another one.
  [[noreturn]] void reject(const std::string& message) const { reject_at(line_, message); }
  [[noreturn]] void reject_at(int line, const std::string& message) const;

  // The number in a word; throws "WHAT: expected a number, found 'WORD'". NaN and infinities are
  // accepted; callers drop positions that contain them.
  [[nodiscard]] double number(std::string_view word, std::string_view what) const;
  // A count of particles: 0 … most_particles.
  [[nodiscard]] std::uint64_t count(std::string_view word, std::string_view what) const;
  [[nodiscard]] std::int64_t integer(std::string_view word, std::string_view what) const;

  // An upper limit for the number of further lines, each of which has at least `shortest`
  // characters. Memory may be reserved for this many, whatever count the file claims.
  [[nodiscard]] std::size_t room(std::uint64_t claimed, std::size_t shortest) const;

  [[nodiscard]] int line() const { return line_; }
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  std::string_view text_;
  std::size_t begin_ = 0;  // offset of the next line
  int line_ = 0;
  std::string file_;
  ProgressSteps progress_;
};

// Like split_words, but into a vector that can be reused.
void split_words_into(std::string_view text, std::vector<std::string_view>& words);

}  // namespace triptych::scene
