#pragma once
// Voxels written as text: hexadecimal digits, base64, or numbers.

#include <string>

#include "scene/inflate.hpp"
#include "scene/voxel_values.hpp"

namespace triptych::scene {

// Each throws InputError with the file where its input is none of the kind. They end where their
// input ends.

// Two digits a byte, with blanks and line ends anywhere.
[[nodiscard]] ByteSource hex_bytes(ByteSource source, std::string file);

// Several runs may follow one another, each padded at its end. Ends at the first letter that belongs
// to none, such as the '<' of a closing tag.
[[nodiscard]] ByteSource base64_bytes(ByteSource source, std::string file);

// Numbers with blanks, line ends or commas between them, as bytes of `type` in native order. Ends at
// a '<', too, where a closing tag begins.
[[nodiscard]] ByteSource text_values(ByteSource source, StoredType type, std::string file);

}  // namespace triptych::scene
