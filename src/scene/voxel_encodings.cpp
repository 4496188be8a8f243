#include "scene/voxel_encodings.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene {
namespace {

// Reads a source character by character.
class Letters {
 public:
  explicit Letters(ByteSource source) : source_(std::move(source)) {}

  std::optional<char> peek() {
    if (at_ == size_) {
      size_ = ended_ ? 0 : source_(buffer_);
      at_ = 0;
      ended_ = size_ < buffer_.size();
      if (size_ == 0) return std::nullopt;
    }
    return static_cast<char>(buffer_[at_]);
  }
  void take() { ++at_; }

  // Returns the next character that is not white space, without consuming it.
  std::optional<char> peek_non_blank() {
    for (auto c = peek(); c; c = peek()) {
      if (*c != ' ' && *c != '\n' && *c != '\r' && *c != '\t') return c;
      take();
    }
    return std::nullopt;
  }

 private:
  ByteSource source_;
  std::vector<std::byte> buffer_ = std::vector<std::byte>(std::size_t{1} << 16U);
  std::size_t at_ = 0;
  std::size_t size_ = 0;
  bool ended_ = false;
};

[[noreturn]] void reject_letter(const std::string& file, std::string_view expected, char found) {
  throw core::InputError({.file = file}, fmt::format("data: expected {}, found '{}'", expected,
                                                     quotable(std::string_view(&found, 1))));
}

std::optional<unsigned> hex_digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a' + 10);
  if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A' + 10);
  return std::nullopt;
}

std::optional<unsigned> base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return static_cast<unsigned>(c - 'A');
  if (c >= 'a' && c <= 'z') return static_cast<unsigned>(c - 'a' + 26);
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0' + 52);
  if (c == '+') return 62U;
  if (c == '/') return 63U;
  return std::nullopt;
}

class HexReader {
 public:
  HexReader(ByteSource source, std::string file)
      : letters_(std::move(source)), file_(std::move(file)) {}

  std::size_t operator()(std::span<std::byte> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      const auto high = digit();
      if (!high) return i;
      const auto low = digit();
      if (!low)
        throw core::InputError({.file = file_},
                               "data: the last byte has only one hexadecimal digit");
      out[i] = static_cast<std::byte>(*high << 4U | *low);
    }
    return out.size();
  }

 private:
  std::optional<unsigned> digit() {
    const auto c = letters_.peek_non_blank();
    if (!c) return std::nullopt;
    const auto value = hex_digit(*c);
    if (!value) reject_letter(file_, "hexadecimal digits", *c);
    letters_.take();
    return value;
  }

  Letters letters_;
  std::string file_;
};

class Base64Reader {
 public:
  Base64Reader(ByteSource source, std::string file)
      : letters_(std::move(source)), file_(std::move(file)) {}

  std::size_t operator()(std::span<std::byte> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (at_ == size_ && !next_group()) return i;
      out[i] = group_.at(at_++);
    }
    return out.size();
  }

 private:
  // Decodes four characters, which represent three bytes. In the last group of a base64 text, '='
  // replaces missing characters.
  bool next_group() {
    unsigned bits = 0;
    unsigned letters = 0;
    unsigned padding = 0;
    for (; letters < 4; ++letters) {
      const auto c = letters_.peek_non_blank();
      const auto digit = c ? base64_digit(*c) : std::nullopt;
      const bool pads = c == '=' && letters >= 2;
      if (!pads && (!digit || padding > 0)) break;
      letters_.take();
      padding += pads ? 1 : 0;
      bits = bits << 6U | digit.value_or(0);
    }
    if (letters == 0) return false;
    if (letters < 4) {
      throw core::InputError({.file = file_},
                             "data: the base64 data end in the middle of a "
                             "group of four characters");
    }
    for (unsigned i = 0; i < 3; ++i) {
      group_.at(i) = static_cast<std::byte>(bits >> (16U - 8U * i) & 0xFFU);
    }
    at_ = 0;
    size_ = 3 - padding;
    return true;
  }

  Letters letters_;
  std::string file_;
  std::array<std::byte, 3> group_{};
  std::size_t at_ = 0;
  std::size_t size_ = 0;
};

template <typename T>
std::optional<std::array<std::byte, 8>> number_bytes(std::string_view word) {
  const auto value = parse_number<T>(word);
  if (!value) return std::nullopt;
  std::array<std::byte, 8> bytes{};
  std::memcpy(bytes.data(), &*value, sizeof(T));
  return bytes;
}

// Parses a value. from_chars() parses std::uint8_t as a number, not as a character.
std::optional<std::array<std::byte, 8>> value_of(std::string_view word, StoredType type) {
  switch (type) {
    case StoredType::u8:
      return number_bytes<std::uint8_t>(word);
    case StoredType::i8:
      return number_bytes<std::int8_t>(word);
    case StoredType::u16:
      return number_bytes<std::uint16_t>(word);
    case StoredType::i16:
      return number_bytes<std::int16_t>(word);
    case StoredType::u32:
      return number_bytes<std::uint32_t>(word);
    case StoredType::i32:
      return number_bytes<std::int32_t>(word);
    case StoredType::u64:
      return number_bytes<std::uint64_t>(word);
    case StoredType::i64:
      return number_bytes<std::int64_t>(word);
    case StoredType::f32:
      return number_bytes<float>(word);
    case StoredType::f64:
      break;
  }
  return number_bytes<double>(word);
}

class TextReader {
 public:
  TextReader(ByteSource source, StoredType type, std::string file)
      : letters_(std::move(source)), type_(type), width_(bytes_of(type)), file_(std::move(file)) {}

  std::size_t operator()(std::span<std::byte> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (at_ == width_ && !next_value()) return i;
      out[i] = value_.at(at_++);
    }
    return out.size();
  }

 private:
  static bool separates(char c) {
    return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == ',';
  }

  bool next_value() {
    constexpr std::size_t longest = 400;  // maximum length of a number
    std::string word;
    auto c = letters_.peek();
    for (; c && separates(*c); c = letters_.peek()) letters_.take();
    for (; c && !separates(*c) && *c != '<' && word.size() < longest; c = letters_.peek()) {
      word += *c;
      letters_.take();
    }
    if (word.empty()) return false;
    const auto value = value_of(word, type_);
    if (!value) {
      throw core::InputError({.file = file_},
                             fmt::format("data: expected a value of type {}, found "
                                         "'{}'",
                                         name_of(type_), quotable(word)));
    }
    value_ = *value;
    at_ = 0;
    return true;
  }

  Letters letters_;
  StoredType type_;
  std::size_t width_;
  std::string file_;
  std::array<std::byte, 8> value_{};
  std::size_t at_ = width_;
};

template <typename Reader>
ByteSource as_source(std::shared_ptr<Reader> reader) {
  return [reader = std::move(reader)](std::span<std::byte> out) { return (*reader)(out); };
}

}  // namespace

ByteSource hex_bytes(ByteSource source, std::string file) {
  return as_source(std::make_shared<HexReader>(std::move(source), std::move(file)));
}

ByteSource base64_bytes(ByteSource source, std::string file) {
  return as_source(std::make_shared<Base64Reader>(std::move(source), std::move(file)));
}

ByteSource text_values(ByteSource source, StoredType type, std::string file) {
  return as_source(std::make_shared<TextReader>(std::move(source), type, std::move(file)));
}

}  // namespace triptych::scene
