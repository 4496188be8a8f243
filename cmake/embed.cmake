# triptych_embed(TARGET NAMESPACE file...)
# Embeds files in TARGET, so that the program does not depend on the working directory. The function `std::string_view
# NAMESPACE::embedded(std::string_view name)` returns the content of a file, or an empty string for an unknown name. Its
# argument is the file name, or the path as given to triptych_embed if two files have the same name. The function
# `std::span<const std::string_view> NAMESPACE::embedded_names()` returns all names. Both functions are declared in the
# generated header "<TARGET>_embedded.hpp". The target property TRIPTYCH_EMBEDDED contains the paths of all files.
function(triptych_embed target namespace)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/embedded)
  file(MAKE_DIRECTORY ${folder})
  set(assembly "    .section .rodata\n")
  set(externs "")
  set(entries "")
  set(names "")
  set(index 0)
  foreach(file IN LISTS ARGN)
    set(path ${file})
    cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    cmake_path(GET file FILENAME name)
    set(symbol ${target}_embedded_${index})
    string(APPEND assembly
      "    .global ${symbol}_begin\n    .global ${symbol}_end\n"
      "${symbol}_begin:\n    .incbin \"${file}\"\n${symbol}_end:\n    .byte 0\n")
    string(APPEND externs "extern \"C\" const char ${symbol}_begin[];\nextern \"C\" const char ${symbol}_end[];\n")
    string(APPEND entries "  if (name == \"${name}\" || name == \"${path}\") return {${symbol}_begin, static_cast<std::size_t>(${symbol}_end - ${symbol}_begin)};\n")
    string(APPEND names "\"${name}\", ")
    list(APPEND files ${file})
    math(EXPR index "${index} + 1")
  endforeach()
  string(APPEND assembly "    .section .note.GNU-stack,\"\",@progbits\n")
  file(CONFIGURE OUTPUT ${folder}/${target}_embedded.S CONTENT "${assembly}")
  file(CONFIGURE OUTPUT ${folder}/${target}_embedded.hpp CONTENT
"#pragma once
#include <span>
#include <string_view>
namespace ${namespace} {
[[nodiscard]] std::string_view embedded(std::string_view name);
[[nodiscard]] std::span<const std::string_view> embedded_names();
}
")
  file(CONFIGURE OUTPUT ${folder}/${target}_embedded.cpp CONTENT
"#include \"${target}_embedded.hpp\"
#include <array>
${externs}
namespace ${namespace} {
std::string_view embedded(std::string_view name) {
${entries}  return {};
}
std::span<const std::string_view> embedded_names() {
  static constexpr std::array<std::string_view, ${index}> names{${names}};
  return names;
}
}
")
  set_source_files_properties(${folder}/${target}_embedded.S PROPERTIES OBJECT_DEPENDS "${files}")
  target_sources(${target} PRIVATE ${folder}/${target}_embedded.S ${folder}/${target}_embedded.cpp)
  target_include_directories(${target} PRIVATE ${folder})
  set_property(TARGET ${target} APPEND PROPERTY TRIPTYCH_EMBEDDED ${files})
endfunction()
