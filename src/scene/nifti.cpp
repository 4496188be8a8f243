#include "scene/nifti.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "core/error.hpp"
#include "scene/compression.hpp"
#include "scene/header_fields.hpp"
#include "scene/raw_voxels.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene {
namespace {

constexpr std::size_t header_bytes_1 = 348;
constexpr std::size_t header_bytes_2 = 540;

// The byte offsets of the fields in the two versions of the header (nifti1.h, nifti2.h).
struct Offsets {
  std::size_t dim, datatype, pixdim, vox_offset, slope, intercept, units, qform_code, sform_code,
      quatern, srow, magic;
};
constexpr Offsets offsets_1{40, 70, 76, 108, 112, 116, 123, 252, 254, 256, 280, 344};
constexpr Offsets offsets_2{16, 12, 104, 168, 176, 184, 500, 344, 348, 352, 400, 4};

// Reads numbers from a header of either version and byte order.
class NiftiHeader {
 public:
  explicit NiftiHeader(const std::filesystem::path& file)
      : file_(file.string()), bytes_(content_start(file, header_bytes_2)) {
    if (bytes_.size() < header_bytes_1) {
      reject(fmt::format("the file has only {} bytes, but a NIfTI header has {} bytes",
                         bytes_.size(), header_bytes_1));
    }
    for (const bool big : {false, true}) {
      big_ = big;
      const auto size = at<std::int32_t>(0);
      if (size != header_bytes_1 && size != header_bytes_2) continue;
      version_ = size == header_bytes_1 ? 1 : 2;
      check_magic();
      return;
    }
    reject(
        "this is not a NIfTI file, because its first 4 bytes do not contain a header size (348 "
        "or 540)");
  }

  [[nodiscard]] bool big_endian() const { return big_; }
  [[nodiscard]] bool is_single_file() const { return bytes_[offsets().magic + 1] == '+'; }
  [[nodiscard]] std::int64_t dim(std::size_t i) const {
    return version_ == 1 ? at<std::int16_t>(offsets().dim + 2 * i)
                         : at<std::int64_t>(offsets().dim + 8 * i);
  }
  [[nodiscard]] double pixdim(std::size_t i) const { return real(offsets().pixdim, i); }
  [[nodiscard]] double slope() const { return real(offsets().slope, 0); }
  [[nodiscard]] double intercept() const { return real(offsets().intercept, 0); }
  [[nodiscard]] double quatern(std::size_t i) const { return real(offsets().quatern, i); }
  [[nodiscard]] double srow(std::size_t row, std::size_t i) const {
    return real(offsets().srow, 4 * row + i);
  }
  [[nodiscard]] int datatype() const { return at<std::int16_t>(offsets().datatype); }
  [[nodiscard]] int units() const {
    return version_ == 1 ? static_cast<unsigned char>(bytes_[offsets().units])
                         : at<std::int32_t>(offsets().units);
  }
  [[nodiscard]] int qform_code() const { return code(offsets().qform_code); }
  [[nodiscard]] int sform_code() const { return code(offsets().sform_code); }
  [[nodiscard]] double vox_offset() const {
    return version_ == 1 ? static_cast<double>(at<float>(offsets().vox_offset))
                         : static_cast<double>(at<std::int64_t>(offsets().vox_offset));
  }
  [[nodiscard]] std::size_t header_bytes() const {
    return version_ == 1 ? header_bytes_1 : header_bytes_2;
  }

  [[noreturn]] void reject(const std::string& message) const {
    throw core::InputError({.file = file_}, message);
  }

 private:
  [[nodiscard]] const Offsets& offsets() const { return version_ == 1 ? offsets_1 : offsets_2; }

  template <typename T>
  [[nodiscard]] T at(std::size_t offset) const {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), bytes_.data() + offset, sizeof(T));
    if (big_ != (std::endian::native == std::endian::big)) std::ranges::reverse(raw);
    T value;
    std::memcpy(&value, raw.data(), sizeof(T));
    return value;
  }
  [[nodiscard]] double real(std::size_t offset, std::size_t i) const {
    return version_ == 1 ? static_cast<double>(at<float>(offset + 4 * i))
                         : at<double>(offset + 8 * i);
  }
  [[nodiscard]] int code(std::size_t offset) const {
    return version_ == 1 ? at<std::int16_t>(offset) : at<std::int32_t>(offset);
  }

  void check_magic() const {
    if (version_ == 2 && bytes_.size() < header_bytes_2) {
      reject(fmt::format("the file has only {} bytes, but a NIfTI-2 header has {} bytes",
                         bytes_.size(), header_bytes_2));
    }
    const std::string_view magic(bytes_.data() + offsets().magic, 4);
    const char digit = version_ == 1 ? '1' : '2';
    const bool known = magic[0] == 'n' && (magic[1] == '+' || magic[1] == 'i') && magic[2] == digit;
    if (known) return;
    const std::string_view stated = std::string_view(bytes_).substr(4, offsets().magic);
    if (std::ranges::count(stated, '\0') == std::ssize(stated)) {
      reject(
          "the header is empty: it specifies neither dimensions nor a data type, so the voxels "
          "cannot be read");
    }
    const bool zeros = std::ranges::count(magic, '\0') == 4;
    reject(fmt::format(
        "the header has the size of a NIfTI-{} header, but contains {} instead of the format name "
        "'n+{}' or 'ni{}'; Analyze 7.5 is not supported, because it does not specify the "
        "orientation",
        version_, zeros ? "zero bytes" : fmt::format("'{}'", quotable(magic)), digit, digit));
  }

  std::string file_;
  std::string bytes_;
  bool big_ = false;
  int version_ = 1;
};

struct Datatype {
  int code;
  StoredType type;
  std::uint64_t components;  // number of consecutive values per voxel
};
constexpr std::array<Datatype, 12> datatypes{{{2, StoredType::u8, 1},
                                              {4, StoredType::i16, 1},
                                              {8, StoredType::i32, 1},
                                              {16, StoredType::f32, 1},
                                              {64, StoredType::f64, 1},
                                              {128, StoredType::u8, 3},
                                              {256, StoredType::i8, 1},
                                              {512, StoredType::u16, 1},
                                              {768, StoredType::u32, 1},
                                              {1024, StoredType::i64, 1},
                                              {1280, StoredType::u64, 1},
                                              {2304, StoredType::u8, 4}}};

const Datatype& datatype_of(const NiftiHeader& header) {
  const auto found = std::ranges::find(datatypes, header.datatype(), &Datatype::code);
  if (found == datatypes.end()) {
    header.reject(
        fmt::format("datatype {} is not supported; expected 8-bit to 64-bit integers, "
                    "32-bit or 64-bit floats, RGB or RGBA",
                    header.datatype()));
  }
  return *found;
}

// Sets the sizes of the three spatial axes. Returns the product of the sizes of all further axes.
std::uint64_t set_nifti_sizes(const NiftiHeader& header, Volume& volume) {
  const std::int64_t axes = header.dim(0);
  if (axes < 3 || axes > 7) {
    header.reject(fmt::format("the volume has {} dimensions; expected 3 to 7", axes));
  }
  std::uint64_t further = 1;
  for (std::size_t i = 1; i <= static_cast<std::size_t>(axes); ++i) {
    const std::int64_t size = header.dim(i);
    if (size < 1 || size > std::numeric_limits<int>::max()) {
      header.reject(fmt::format("size {} along dimension {}; expected a whole number from 1 to {}",
                                size, i, std::numeric_limits<int>::max()));
    }
    if (i <= 3) {
      volume.size.at(i - 1) = static_cast<int>(size);
    } else {
      // The multiplication stops when the product exceeds 32 bits, so that it cannot overflow. A
      // product of this size is rejected later, when the bytes are counted.
      further = further > std::numeric_limits<std::uint32_t>::max()
                    ? further
                    : further * static_cast<std::uint64_t>(size);
    }
  }
  return further;
}

std::array<double, 3> spacing_of(const NiftiHeader& header, const Volume& volume,
                                 const std::string& file) {
  std::array<double, 3> spacing{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = std::abs(header.pixdim(i + 1));
    spacing.at(i) = usable_spacing(length == 0 ? 1 : length, volume.size.at(i), {.file = file});
  }
  return spacing;
}

// Returns the columns of the matrix that maps voxels to millimetres, computed from the quaternion
// (method 2 in nifti1.h).
std::array<Vector3, 3> axes_of_quaternion(const NiftiHeader& header,
                                          const std::array<double, 3>& spacing) {
  const double b = header.quatern(0);
  const double c = header.quatern(1);
  const double d = header.quatern(2);
  const double a = std::sqrt(std::max(0.0, 1 - b * b - c * c - d * d));
  std::array<Vector3, 3> axes{
      {{a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)},
       {2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)},
       {2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - b * b - c * c}}};
  const double mirrored = header.pixdim(0) < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i) {
    for (double& each : axes.at(i)) each *= spacing.at(i) * (i == 2 ? mirrored : 1);
  }
  return axes;
}

std::array<Vector3, 3> axes_of_matrix(const NiftiHeader& header) {
  std::array<Vector3, 3> axes{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t row = 0; row < 3; ++row) axes.at(i).at(row) = header.srow(row, i);
  }
  return axes;
}

void note_orientation(const NiftiHeader& header, Volume& volume) {
  constexpr double allowed = 1e-3;
  if (header.sform_code() > 0) {
    const auto axes = axes_of_matrix(header);
    volume.facts.orientation = anatomical_letters(axes, "RAS");
    for (std::size_t i = 0; i < 3; ++i) {
      const double length = length_of(axes.at(i));
      if (std::abs(length - volume.spacing.at(i)) <= allowed * volume.spacing.at(i)) continue;
      volume.facts.notes.push_back(
          fmt::format("the spacing of axis {} is {} according to pixdim, but {} according to the "
                      "sform matrix; the value from pixdim is used",
                      i, volume.spacing.at(i), length));
    }
    if (const std::string sheared = sheared_axes(axes); !sheared.empty()) {
      volume.facts.notes.push_back(
          fmt::format("{} are not perpendicular in the sform matrix; the grid is drawn with "
                      "perpendicular axes",
                      sheared));
    }
  } else if (header.qform_code() > 0) {
    volume.facts.orientation =
        anatomical_letters(axes_of_quaternion(header, volume.spacing), "RAS");
  }
}

std::string unit_name(int code) {
  switch (code & 7) {
    case 1:
      return "m";
    case 2:
      return "mm";
    case 3:
      return "µm";
    default:
      return {};
  }
}

// Returns the .img file that belongs to a .hdr file. Either may be compressed.
std::filesystem::path find_voxel_file(const std::filesystem::path& file,
                                      const NiftiHeader& header) {
  std::filesystem::path stem = file;
  const std::string last = lower_case(file.extension().string());
  if (last == ".gz" || last == ".bz2") stem.replace_extension();
  for (const char* ending : {".img", ".img.gz", ".img.bz2", ".IMG"}) {
    std::filesystem::path image = stem;
    image.replace_extension(ending);
    std::error_code unreadable;
    if (std::filesystem::is_regular_file(image, unreadable)) return image;
  }
  header.reject(fmt::format("the voxel file '{}' does not exist",
                            stem.replace_extension(".img").filename().string()));
}

std::uint64_t start_of_voxels(const NiftiHeader& header) {
  const double offset = header.vox_offset();
  // If header and voxels are in a single file, four bytes after the header state whether extensions
  // follow.
  const std::size_t least = header.is_single_file() ? header.header_bytes() + 4 : 0;
  if (offset == 0) return least;
  constexpr double most = 0x1.0p53;
  if (!(offset >= static_cast<double>(least) && offset <= most) || offset != std::floor(offset)) {
    header.reject(
        fmt::format("the voxels begin at byte {} (vox_offset); expected a whole number, {} or more",
                    offset, least));
  }
  return static_cast<std::uint64_t>(offset);
}

}  // namespace

Volume read_nifti(const std::filesystem::path& file, const Component& component) {
  const NiftiHeader header(file);
  const Datatype& datatype = datatype_of(header);
  Volume volume;
  RawVoxels source;
  const std::uint64_t further = set_nifti_sizes(header, volume);
  if (datatype.components > 1 && further > 1) {
    header.reject(
        "the volume has both colour channels and a fourth dimension; only one of them "
        "is supported");
  }
  volume.spacing = spacing_of(header, volume, file.string());
  volume.facts.unit = unit_name(header.units());
  note_orientation(header, volume);
  source.file = header.is_single_file() ? file : find_voxel_file(file, header);
  source.packing = packing_of_file(source.file);
  source.start = start_of_voxels(header);
  if (header.is_single_file() && header.vox_offset() == 0) {
    volume.facts.notes.push_back(fmt::format(
        "vox_offset is 0, so the voxels are read starting at byte {}, where they begin in files "
        "without header extensions",
        source.start));
  }
  source.layout.type = datatype.type;
  source.layout.big_endian = header.big_endian();
  source.layout.components = datatype.components * further;
  if (further > 1) source.layout.block = volume.voxel_count();
  // A slope of 0 means that there is no scaling. Colours are not scaled either.
  const double slope = header.slope();
  const double intercept = header.intercept();
  if (slope != 0 && std::isfinite(slope) && std::isfinite(intercept) && datatype.components == 1) {
    source.layout.slope = slope;
    source.layout.intercept = intercept;
  }
  source.component = component;
  source.more_may_follow = true;
  source.sizes_place = {.file = file.string()};
  read_voxels(volume, source);
  return volume;
}

}  // namespace triptych::scene
