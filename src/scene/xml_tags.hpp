#pragma once
// Reads the tags of an XML file one by one, with the position at which each tag ends. This is
// useful for formats with large amounts of data between the tags. It is not a complete XML parser,
// because entities in attributes are not replaced.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/inflate.hpp"

namespace triptych::scene {

struct XmlTag {
  std::string name;  // "/NAME" for a closing tag
  std::map<std::string, std::string> attributes;
  bool empty = false;     // <NAME/>
  std::uint64_t end = 0;  // position of the byte after '>'

  [[nodiscard]] std::string attribute(const std::string& key,
                                      const std::string& default_value = {}) const {
    const auto found = attributes.find(key);
    return found == attributes.end() ? default_value : found->second;
  }
};

class XmlTags {
 public:
  XmlTags(ByteSource source, std::string file);

  // Returns the next tag, or nullopt at the end. Skips comments, declarations and the text between
  // tags. Throws InputError for a tag that does not end or is too long.
  [[nodiscard]] std::optional<XmlTag> next();

 private:
  [[nodiscard]] std::optional<char> letter();
  [[nodiscard]] std::string until_end();
  [[nodiscard]] XmlTag parse(std::string_view text) const;

  ByteSource source_;
  std::string file_;
  std::vector<std::byte> buffer_;
  std::size_t at_ = 0;
  std::size_t size_ = 0;
  std::uint64_t taken_ = 0;
};

}  // namespace triptych::scene
