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

// The largest number of particles. Ids have 32 bits, and the highest id means "none".
inline constexpr std::uint64_t most_particles = 0xFFFFFFFEU;

// Reads text line by line, and counts the lines so that errors can name the file and the line. The
// text must outlive the reader.
class LineReader {
 public:
  LineReader(std::string_view text, std::string file, ProgressSteps progress);

  // Returns the next line without its line end (LF or CR LF), or nullopt after the last line.
  [[nodiscard]] std::optional<std::string_view> next();
  // Returns the next line. If there is none, throws InputError with the message that the file ends
  // where `what` was expected.
  [[nodiscard]] std::string_view require(std::string_view what);
  // Skips blank lines. Returns true if nothing follows them.
  [[nodiscard]] bool at_end();
  // Skips `count` lines. Throws InputError if there are fewer, like require().
  void skip(std::uint64_t count, std::string_view what);

  // Returns a hint to append to a message about a line that is too short: that the file may be
  // truncated. Returns an empty string if other lines follow.
  [[nodiscard]] std::string truncation_hint() const;
  // Returns the number of frames in the rest of the text. Each frame consists of `before` lines, a
  // line with a number N, and N + `after` further lines. Returns nullopt if the text does not
  // consist of such frames.
  [[nodiscard]] std::optional<std::uint64_t> count_frames(int before, int after) const;
  // Returns the number of lines in the rest of the text that begin with `start`.
  [[nodiscard]] std::uint64_t count_lines(std::string_view start) const;

  // Throw InputError. The error names the last line that was read, or `line`.
  [[noreturn]] void reject(const std::string& message) const { reject_at(line_, message); }
  [[noreturn]] void reject_at(int line, const std::string& message) const;

  // Returns the number in a word. If it is not a number, throws "WHAT: expected a number, found
  // 'WORD'". NaN and infinities are accepted. Callers drop positions that contain them.
  [[nodiscard]] double number(std::string_view word, std::string_view what) const;
  // Returns a number of particles, which must be at most most_particles.
  [[nodiscard]] std::uint64_t count(std::string_view word, std::string_view what) const;
  [[nodiscard]] std::int64_t integer(std::string_view word, std::string_view what) const;

  // Returns the number of entries to reserve memory for. This is `claimed`, but at most the number
  // of lines that the rest of the text can contain if each line has at least `shortest` characters.
  // A file that claims too many entries therefore cannot exhaust the memory.
  [[nodiscard]] std::size_t reservation(std::uint64_t claimed, std::size_t shortest) const;

  [[nodiscard]] int line() const { return line_; }
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  std::string_view text_;
  std::size_t begin_ = 0;  // offset of the next line
  int line_ = 0;
  std::string file_;
  ProgressSteps progress_;
};

// Like split_words(), but writes the words to a vector that the caller can reuse.
void split_words_into(std::string_view text, std::vector<std::string_view>& words);

}  // namespace triptych::scene
