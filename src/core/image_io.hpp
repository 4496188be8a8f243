#pragma once
// Image files: OpenEXR for keeping (32-bit float R, G, B, A; particles also Z and id, uint32), PNG
// for looking.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/image.hpp"

namespace triptych::core {

// Lossless (ZIP-compressed scan lines, full float). Throws IoError when the file cannot be written.
void write_exr(const Image& image, const std::filesystem::path& file);
[[nodiscard]] std::vector<std::byte> encode_exr(const Image& image);

// Throws IoError (missing, unreadable) or InputError (not an EXR file with R, G, B, A of one size).
[[nodiscard]] Image read_exr(const std::filesystem::path& file);
// `name`: what errors call the picture.
[[nodiscard]] Image decode_exr(std::span<const std::byte> bytes,
                               const std::string& name = "a picture");

// 8-bit sRGB, opaque: the image over a black background, clamped to [0, 1]; NaN shows as magenta.
void write_png(const Image& image, const std::filesystem::path& file);
[[nodiscard]] std::vector<std::byte> encode_png(const Image& image);

}  // namespace triptych::core
