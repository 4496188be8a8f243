#include "judge/baselines/next_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "core/json_file.hpp"
#include "core/json_text.hpp"

namespace triptych::judge {
namespace {

using core::Json;

constexpr std::size_t most_listed_values = 40;

Json flattened(const Json& value) {
  return value.is_null() ? Json::object() : value.flatten();
}

// Returns a JSON pointer without the leading slash and with its escape sequences decoded.
std::string unescaped_pointer(std::string pointer) {
  constexpr std::array<std::pair<std::string_view, char>, 2> escapes{{{"~1", '/'}, {"~0", '~'}}};
  for (const auto& [escape, character] : escapes) {
    for (auto at = pointer.find(escape); at != std::string::npos;
         at = pointer.find(escape, at + 1)) {
      pointer.replace(at, escape.size(), 1, character);
    }
  }
  return pointer.substr(1);
}

std::string text_of(const std::vector<std::byte>& bytes) {
  std::string text(bytes.size(), '\0');
  std::ranges::transform(bytes, text.begin(),
                         [](std::byte each) { return static_cast<char>(each); });
  return text;
}

}  // namespace

std::vector<std::byte> bytes_of(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
  return {bytes.begin(), bytes.end()};
}

Update::Update(NextFolder& next, std::string name) : next_(next), name_(std::move(name)) {
  const auto file = next.files.find(name_);
  if (file != next.files.end()) before_ = core::JsonFile(name_, text_of(file->second)).value();
  after_ = before_;
}

void Update::write(int depth) const {
  if (after_ == before_) return;
  next_.files[name_] = bytes_of(core::to_lines(after_, depth));
  describe();
}

void Update::describe() const {
  const Json before = flattened(before_);
  const Json after = flattened(after_);
  std::vector<std::string> values;
  std::size_t added = 0;
  for (const auto& item : after.items()) {
    const auto old = before.find(item.key());
    if (old == before.end()) ++added;
    if (old == before.end() || *old == item.value()) continue;
    values.push_back(fmt::format("  {}: {} → {}", unescaped_pointer(item.key()),
                                 core::json_text(*old), core::json_text(item.value())));
  }
  const auto removed = std::ranges::count_if(
      before.items(), [&](const auto& item) { return !after.contains(item.key()); });
  next_.lines.push_back(
      fmt::format("{}: {} changed, {} added, {} removed", name_, values.size(), added, removed));
  const auto shown = std::min(std::ssize(values), static_cast<std::ptrdiff_t>(most_listed_values));
  next_.lines.insert(next_.lines.end(), values.begin(), values.begin() + shown);
  if (std::ssize(values) > shown) {
    next_.lines.push_back(fmt::format("  … and {} more", std::ssize(values) - shown));
  }
}

}  // namespace triptych::judge
