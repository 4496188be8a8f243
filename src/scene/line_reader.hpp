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

// The largest number of particles: ids are 32 bits wide, and the highest stands for "none".
inline constexpr std::uint64_t most_particles = 0xFFFFFFFEU;

// Walks over the lines of a text and knows where it is, so that whatever is wrong can be named with
// file and line. The text must outlive the reader.
class LineReader {
 public:
  LineReader(std::string_view text, std::string file, ProgressSteps progress);

  // The next line without its end (LF or CR LF), or nothing after the last one.
  [[nodiscard]] std::optional<std::string_view> next();
  // The next line; throws InputError "ends where WHAT was expected".
  [[nodiscard]] std::string_view require(std::string_view what);
  // Whether nothing but blank lines is left. They are taken.
  [[nodiscard]] bool at_end();
  // Drops so many lines, all of which must be there.
  void skip(std::uint64_t count, std::string_view what);

  // Throws InputError at the last line read (or at another one).
  [[noreturn]] void reject(const std::string& message) const { reject_at(line_, message); }
  [[noreturn]] void reject_at(int line, const std::string& message) const;

  // The number a word spells; throws "WHAT: expected a number, found 'WORD'". NaN and infinities
  // are numbers here; whoever takes a place from them drops it.
  [[nodiscard]] double number(std::string_view word, std::string_view what) const;
  // A count of particles: 0 … most_particles.
  [[nodiscard]] std::uint64_t count(std::string_view word, std::string_view what) const;
  [[nodiscard]] std::int64_t integer(std::string_view word, std::string_view what) const;

  // An upper bound of how many further lines of `shortest` characters there can be: what may be
  // reserved for a count that a file claims.
  [[nodiscard]] std::size_t room(std::uint64_t claimed, std::size_t shortest) const;

  [[nodiscard]] int line() const { return line_; }
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  std::string_view text_;
  std::size_t begin_ = 0;  // of the line that comes next
  int line_ = 0;
  std::string file_;
  ProgressSteps progress_;
};

// As split_words, into a vector that is used again and again.
void split_words_into(std::string_view text, std::vector<std::string_view>& words);

}  // namespace triptych::scene
