#pragma once
// The comment line of extended XYZ, after its specification (https://github.com/libAtoms/extxyz):
// KEY=VALUE pairs and single keys, where a value is a word, a quoted text, or a list in brackets or
// braces.

#include <optional>
#include <string>
#include <string_view>

namespace triptych::scene {

struct XyzComment {
  // The value of `Properties`, in any case; nothing where no key of that name is there.
  std::optional<std::string> properties;
  // Why the comment cannot be read by the specification though it may be meant so: it has
  // "Properties=" in it, but a quote or bracket is never closed, or the key is there twice.
  std::string error;
};

[[nodiscard]] XyzComment parse_xyz_comment(std::string_view comment);

}  // namespace triptych::scene
