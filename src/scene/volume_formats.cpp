#include "scene/volume_formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "core/error.hpp"
#include "scene/compression.hpp"
#include "scene/dat.hpp"
#include "scene/format_advice.hpp"
#include "scene/metaimage.hpp"
#include "scene/nifti.hpp"
#include "scene/nrrd.hpp"
#include "scene/text_lines.hpp"
#include "scene/vtk_image.hpp"

namespace triptych::scene {
namespace {

bool begins_as_nrrd(std::string_view start) {
  return start.starts_with("NRRD000");
}

// The file begins with the size of its header in either byte order: 348 bytes in version 1, or 540
// bytes in version 2.
bool begins_as_nifti(std::string_view start) {
  constexpr std::array<std::string_view, 4> sizes{
      std::string_view("\x5C\x01\0\0", 4), std::string_view("\0\0\x01\x5C", 4),
      std::string_view("\x1C\x02\0\0", 4), std::string_view("\0\0\x02\x1C", 4)};
  return start.size() >= 348 &&
         std::ranges::any_of(sizes, [&](auto size) { return start.starts_with(size); });
}

bool begins_as_metaimage(std::string_view start) {
  const std::string word = lower_case(start.substr(0, start.find_first_of(" =\n")));
  return word == "objecttype" || word == "ndims";
}

bool begins_as_vti(std::string_view start) {
  return start.find("<VTKFile") != std::string_view::npos &&
         start.find("ImageData") != std::string_view::npos;
}

bool begins_as_vtk(std::string_view start) {
  return start.starts_with("# vtk DataFile Version");
}

bool never_matches(std::string_view /*start*/) {
  return false;
}

constexpr std::array<VolumeFormat, 6> formats_of_volumes{
    {{"NRRD", ".nrrd .nhdr", begins_as_nrrd, read_nrrd},
     {"NIfTI", ".nii .hdr", begins_as_nifti, read_nifti},
     {"MetaImage", ".mha .mhd", begins_as_metaimage, read_metaimage},
     {"VTK image data", ".vti", begins_as_vti, read_vti},
     {"VTK legacy", ".vtk", begins_as_vtk, read_vtk},
     {"DAT", ".dat", never_matches, read_dat}}};

std::string ending_of_volume(const std::filesystem::path& file) {
  const std::string last = lower_case(file.extension().string());
  const bool packed = last == ".gz" || last == ".bz2";
  return packed ? lower_case(file.stem().extension().string()) : last;
}

}  // namespace

std::span<const VolumeFormat> volume_formats() {
  return formats_of_volumes;
}

const VolumeFormat& volume_format(const std::filesystem::path& file) {
  constexpr std::size_t start_bytes = 4096;
  const std::string ending = ending_of_volume(file);
  const std::string start = content_start(file, start_bytes);
  const auto& formats = formats_of_volumes;
  const auto named = std::ranges::find_if(
      formats, [&](const VolumeFormat& format) { return has_ending(format.endings, ending); });
  const auto begun = std::ranges::find_if(
      formats, [&](const VolumeFormat& format) { return format.begins(start); });
  if (named == formats.end() && begun == formats.end()) {
    throw core::InputError({.file = file.string()}, volume_advice(ending, start));
  }
  if (named == formats.end()) return *begun;
  if (begun != formats.end() && begun != named) {
    throw core::InputError(
        {.file = file.string()},
        fmt::format("the file extension indicates the format {} ({}), but the content looks like "
                    "{}; if the content is correct, change the extension to {}",
                    named->name, ending, begun->name, split_words(begun->endings).front()));
  }
  return *named;
}

}  // namespace triptych::scene
