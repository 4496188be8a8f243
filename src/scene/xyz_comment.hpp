#pragma once
// Parses the comment line of extended XYZ according to its specification
// (https://github.com/libAtoms/extxyz). The line consists of KEY=VALUE pairs and single keys, where
// a value is a word, a quoted text, or a list in brackets or braces.

#include <optional>
#include <string>
#include <string_view>

namespace triptych::scene {

struct XyzComment {
  // The value of the key `Properties` (in upper or lower case); nullopt if there is no such key.
  std::optional<std::string> properties;
  // The reason why the comment is not valid extended XYZ although it is probably meant to be: it
  // contains "Properties=", but a quote or bracket is never closed, or the key appears twice.
  std::string error;
};

[[nodiscard]] XyzComment parse_xyz_comment(std::string_view comment);

}  // namespace triptych::scene
