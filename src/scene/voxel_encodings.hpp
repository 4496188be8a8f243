#pragma once
// Readers of voxels that are stored as text: hexadecimal digits, base64, or numbers.

#include <string>

#include "scene/inflate.hpp"
#include "scene/voxel_values.hpp"

namespace triptych::scene {

// Each function throws InputError with the file's name if its input is not in the expected
// encoding, and stops at the end of the input.

// Reads two hexadecimal digits per byte. White space is allowed anywhere.
[[nodiscard]] ByteSource hex_bytes(ByteSource source, std::string file);

// Reads base64. Several base64 texts may follow one another, each with its own padding. Reading
// stops at the first character that does not belong to the encoding, such as the '<' of a closing
// tag.
[[nodiscard]] ByteSource base64_bytes(ByteSource source, std::string file);

// Reads numbers that are separated by white space or commas, and returns them as bytes of `type` in
// native byte order. Reading also stops at a '<', where a closing tag begins.
[[nodiscard]] ByteSource text_values(ByteSource source, StoredType type, std::string file);

}  // namespace triptych::scene
