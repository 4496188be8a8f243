#pragma once
// Image files: OpenEXR for storage (32-bit floats R, G, B, A; for particles also Z and the uint32
// id), PNG for viewing.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/image.hpp"

namespace triptych::core {

// Lossless (ZIP-compressed scan lines, full floats). Throws IoError if the file cannot be written.
void write_exr(const Image& image, const std::filesystem::path& file);
[[nodiscard]] std::vector<std::byte> encode_exr(const Image& image);

// Throws IoError (missing, unreadable) or InputError (not an EXR file with R, G, B and A of the
// same size).
[[nodiscard]] Image read_exr(const std::filesystem::path& file);
// `name` is the name of the image in errors.
[[nodiscard]] Image decode_exr(std::span<const std::byte> bytes,
                               const std::string& name = "an image");

// Writes 8-bit sRGB without alpha: the image over a black background, clamped to [0, 1]. NaN is
// shown as magenta.
void write_png(const Image& image, const std::filesystem::path& file);
[[nodiscard]] std::vector<std::byte> encode_png(const Image& image);

}  // namespace triptych::core
