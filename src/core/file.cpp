#include "core/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <limits>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include "core/error.hpp"

namespace triptych::core {
namespace {

[[noreturn]] void fail(std::string_view what, const std::filesystem::path& file, int code) {
  throw IoError(
      fmt::format("{}: {}: {}", file.string(), what, std::generic_category().message(code)));
}

class Descriptor {
 public:
  explicit Descriptor(int fd) noexcept : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(other.release()) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  [[nodiscard]] int get() const noexcept { return fd_; }
  [[nodiscard]] int release() noexcept { return std::exchange(fd_, -1); }

 private:
  int fd_;
};

// A file that the destructor removes, unless finished() was called.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(std::filesystem::path file) : file_(std::move(file)) {}
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
  ~UnfinishedFile() {
    std::error_code ignored;
    if (!file_.empty()) std::filesystem::remove(file_, ignored);
  }
  void finished() noexcept { file_.clear(); }

 private:
  std::filesystem::path file_;
};

// Writes the bytes and closes the file. Also checks the result of close(), because some file
// systems report a full disk only then. Errors name `target` instead of the temporary file, whose
// name means nothing to the user.
void write_and_close(Descriptor& out, std::span<const std::byte> bytes,
                     const std::filesystem::path& target) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(out.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("cannot write", target, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  if (::close(out.release()) != 0) fail("cannot write", target, errno);
}

// Uses O_NONBLOCK, because opening a pipe that has no writer would block otherwise.
Descriptor open_to_read(const std::filesystem::path& file, struct stat& facts) {
  Descriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (in.get() < 0 || ::fstat(in.get(), &facts) != 0) fail("cannot read", file, errno);
  if (S_ISDIR(facts.st_mode)) fail("cannot read", file, EISDIR);
  if (!S_ISREG(facts.st_mode)) {
    throw IoError(fmt::format(
        "{}: cannot be read because it is a pipe or a device, not a regular file", file.string()));
  }
  return in;
}

template <typename Bytes>
Bytes read_at_most(const std::filesystem::path& file, std::size_t most) {
  const auto check_size = [&](std::size_t size) {
    if (size <= most) return;
    throw InputError({.file = file.string()},
                     fmt::format("is too large; the limit is {} bytes", most));
  };
  struct stat facts {};
  const Descriptor in = open_to_read(file, facts);
  check_size(static_cast<std::size_t>(facts.st_size));
  // The buffer is one byte larger than the reported file size, so that read() can detect the end of
  // the file without having to enlarge the buffer.
  Bytes bytes(static_cast<std::size_t>(facts.st_size) + 1, typename Bytes::value_type{});
  std::size_t filled = 0;
  for (;;) {
    const ssize_t count = ::read(in.get(), bytes.data() + filled, bytes.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("cannot read", file, errno);
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
    check_size(filled);
    if (filled == bytes.size()) bytes.resize(2 * bytes.size());
  }
  bytes.resize(filled);
  return bytes;
}

void write_in_place(std::span<const std::byte> bytes, const std::filesystem::path& target) {
  Descriptor out(::open(target.c_str(), O_WRONLY | O_CLOEXEC));
  if (out.get() < 0) fail("cannot write", target, errno);
  write_and_close(out, bytes, target);
}

// A complete file under a temporary name next to its target. finish() gives it the target's name.
// Without finish(), the destructor removes it, and the target keeps its old content.
class StagedFile {
 public:
  StagedFile(std::span<const std::byte> bytes, std::filesystem::path file)
      : file_(std::move(file)) {
    std::error_code none;
    target_ = std::filesystem::is_symlink(file_, none)
                  ? std::filesystem::weakly_canonical(file_, none)
                  : file_;
    const auto status = std::filesystem::status(target_, none);
    if (std::filesystem::is_directory(status)) fail("cannot write", file_, EISDIR);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
      write_in_place(bytes, target_);
      return;
    }
    // Each writer uses a temporary file with a unique name, so that two writers never write to the
    // same file.
    int fd = -1;
    for (int attempt = 0; fd < 0 && (attempt == 0 || errno == EEXIST); ++attempt) {
      temporary_ = target_;
      temporary_ += fmt::format(".{}-{}.part", ::getpid(), attempt);
      fd = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    }
    Descriptor out(fd);
    if (out.get() < 0) fail("cannot write", file_, errno);
    guard_ = std::make_unique<UnfinishedFile>(temporary_);
    write_and_close(out, bytes, file_);
  }

  void finish() {
    if (!guard_) return;  // was written in place
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail("cannot write", file_, errno);
    guard_->finished();
  }

 private:
  std::filesystem::path file_;
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  std::unique_ptr<UnfinishedFile> guard_;
};

}  // namespace

std::vector<std::byte> read_file(const std::filesystem::path& file) {
  return read_at_most<std::vector<std::byte>>(file, std::numeric_limits<std::size_t>::max());
}

std::string read_text(const std::filesystem::path& file, std::size_t most) {
  return read_at_most<std::string>(file, most);
}

void write_file(std::span<const std::byte> bytes, const std::filesystem::path& file) {
  StagedFile(bytes, file).finish();
}

void write_file(std::string_view text, const std::filesystem::path& file) {
  write_file(std::as_bytes(std::span(text.data(), text.size())), file);
}

void write_files(const std::vector<FileContent>& files) {
  std::vector<StagedFile> staged;
  staged.reserve(files.size());
  for (const auto& [file, bytes] : files) staged.emplace_back(bytes, file);
  for (StagedFile& each : staged) each.finish();
}

}  // namespace triptych::core
