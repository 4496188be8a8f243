#include "measure/truth/own_seal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>

#include "core/error.hpp"
#include "core/private_folder.hpp"
#include "core/sha256.hpp"
#include "measure/system/environment.hpp"
#include "measure/system/process.hpp"

namespace triptych::measure {
namespace {

constexpr std::size_t key_bytes = 32;

std::string text_of(const std::array<std::uint8_t, 32>& hash) {
  return {hash.begin(), hash.end()};
}

// Returns the secret key with which seals are computed, or an empty string if there is no key that
// only this user can read.
std::string read_key(const core::PrivateFolder& folder) {
  const FileDescriptor file(::openat(folder.fd(), "key", O_RDONLY | O_NOFOLLOW | O_CLOEXEC));
  struct stat status {};
  if (!file || ::fstat(file.get(), &status) != 0) return {};
  const bool own = status.st_uid == ::geteuid() && (status.st_mode & 077) == 0;
  std::string key(key_bytes, '\0');
  const ssize_t got = own ? ::read(file.get(), key.data(), key.size()) : 0;
  return got == static_cast<ssize_t>(key_bytes) ? key : std::string();
}

// Creates the secret key with which seals are computed. The key is first written to another file,
// and then linked under its final name. If several processes create keys at the same time, all of
// them then use the key that was linked first.
void make_key(const core::PrivateFolder& folder) {
  std::string key(key_bytes, '\0');
  if (::getrandom(key.data(), key.size(), 0) != static_cast<ssize_t>(key.size())) return;
  const std::string temporary = fmt::format("key-{}", ::getpid());
  const FileDescriptor file(::openat(folder.fd(), temporary.c_str(),
                                     O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
  if (!file) return;
  const bool written =
      ::write(file.get(), key.data(), key.size()) == static_cast<ssize_t>(key.size());
  if (written) static_cast<void>(::linkat(folder.fd(), temporary.c_str(), folder.fd(), "key", 0));
  static_cast<void>(::unlinkat(folder.fd(), temporary.c_str(), 0));
}

std::string own_key() {
  try {
    const core::PrivateFolder folder = cache_folder("references");
    std::string key = read_key(folder);
    if (!key.empty()) return key;
    make_key(folder);
    return read_key(folder);
  } catch (const core::IoError&) {
    return {};
  }
}

std::string_view text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

std::string hmac_sha256(std::string_view key, std::string_view message) {
  constexpr std::size_t block_bytes = 64;
  std::string padded = key.size() > block_bytes ? text_of(core::sha256(key)) : std::string(key);
  padded.resize(block_bytes, '\0');
  std::string inner = padded;
  std::string outer = padded;
  for (char& c : inner) c = static_cast<char>(c ^ 0x36);
  for (char& c : outer) c = static_cast<char>(c ^ 0x5c);
  const std::string hash = text_of(core::sha256(inner.append(message)));
  return fmt::format("{:02x}", fmt::join(core::sha256(outer + hash), ""));
}

std::optional<std::string> own_seal(const record::TruthImage& truth) {
  const std::string key = own_key();
  if (key.empty()) return std::nullopt;
  std::string message = text_of(core::sha256(truth.scene)) + text_of(core::sha256(truth.version));
  message += text_of(core::sha256(text_of(truth.image)));
  message += text_of(core::sha256(text_of(truth.bound)));
  return hmac_sha256(key, message);
}

}  // namespace triptych::measure
