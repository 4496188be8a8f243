#pragma once
// Contents of test volumes: values of every type in both byte orders, plain or compressed.

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::scene {

template <typename T>
std::string bytes_of_values(const std::vector<T>& values, bool big_endian) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  if (big_endian != (std::endian::native == std::endian::big)) {
    for (std::size_t i = 0; i < bytes.size(); i += sizeof(T)) {
      std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(i),
                   bytes.begin() + static_cast<std::ptrdiff_t>(i + sizeof(T)));
    }
  }
  return bytes;
}

// Returns 24 values (2 x 3 x 4), including the smallest and the largest value of the type.
template <typename T>
std::vector<T> typical_values() {
  std::vector<T> values{std::numeric_limits<T>::lowest(), std::numeric_limits<T>::max()};
  for (int i = 2; i < 24; ++i) values.push_back(static_cast<T>(i * 5));
  return values;
}

inline std::string gzipped(std::string_view plain) {
  z_stream zlib{};
  if (deflateInit2(&zlib, 6, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::runtime_error("deflateInit2");
  }
  std::string packed(deflateBound(&zlib, static_cast<uLong>(plain.size())), '\0');
  std::string input(plain);
  zlib.next_in = reinterpret_cast<Bytef*>(input.data());
  zlib.avail_in = static_cast<uInt>(input.size());
  zlib.next_out = reinterpret_cast<Bytef*>(packed.data());
  zlib.avail_out = static_cast<uInt>(packed.size());
  const int code = deflate(&zlib, Z_FINISH);
  packed.resize(zlib.total_out);
  deflateEnd(&zlib);
  if (code != Z_STREAM_END) throw std::runtime_error("deflate");
  return packed;
}

}  // namespace triptych::scene
