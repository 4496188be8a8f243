#pragma once
// Parses the comment line of extended XYZ according to its specification
// (https://github.com/libAtoms/extxyz). The line consists of KEY=VALUE pairs and single keys. A
// value is a word, a quoted string, or a list in brackets or braces.

#include <optional>
#include <string>
#include <string_view>

namespace triptych::scene {

struct XyzComment {
  // The value of the key `Properties` (in upper or lower case), or nullopt if there is no such key.
  std::optional<std::string> properties;
  // The reason why the comment is not valid extended XYZ: a quote or bracket is never closed, or
  // the key `Properties` appears twice. Empty if the comment is valid, or if it does not contain
  // "Properties=" (a plain XYZ file may have any comment).
  std::string error;
};

[[nodiscard]] XyzComment parse_xyz_comment(std::string_view comment);

}  // namespace triptych::scene
