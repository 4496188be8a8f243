#pragma once
// A folder for stores, and processes that misuse them.

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "record/store.hpp"
#include "samples.hpp"

namespace triptych::record {

// A store with one run and one record.
inline void make_store(const std::filesystem::path& file) {
  Store store(file, Store::Mode::append);
  store.add_run(sample_run());
  store.add_record(sample_record());
}

inline std::vector<std::byte> bytes_of(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

// A disk of 1 MiB that only this process sees; needs no root where users may have namespaces.
inline bool mount_small_disk(const std::filesystem::path& folder) {
  const uid_t user = geteuid();
  if (unshare(CLONE_NEWNS) != 0) {
    if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
    std::ofstream("/proc/self/uid_map") << "0 " << user << " 1";
  }
  return mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
         mount("none", folder.c_str(), "tmpfs", 0, "size=1m") == 0;
}

// From now on, no file of this process can have more than this many bytes.
inline void limit_files(rlim_t bytes) {
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{.rlim_cur = bytes, .rlim_max = bytes};
  setrlimit(RLIMIT_FSIZE, &limit);
}

class StoreTest : public ::testing::Test {
 protected:
  StoreTest() {
    std::string pattern = ::testing::TempDir() + "triptych-store-XXXXXX";
    folder_ = mkdtemp(pattern.data());
    // Gives other users access, because some tests drop the rights of root, for whom nothing is
    // read-only.
    std::filesystem::permissions(folder_, std::filesystem::perms::all);
    // The name contains characters that must be escaped in a URI of SQLite.
    file_ = folder_ / "a store?#%.sqlite";
  }
  ~StoreTest() override {
    std::filesystem::permissions(folder_, std::filesystem::perms::all);
    std::filesystem::remove_all(folder_);
  }

  // Runs `action` in a separate process, and returns its text or the text of its exception.
  static std::string in_child(const std::function<std::string()>& action) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) return "no pipe";
    const pid_t child = fork();
    if (child == 0) {
      std::string text;
      try {
        text = action();
      } catch (const std::exception& error) {
        text = error.what();
      }
      const auto written = write(ends[1], text.data(), text.size());
      std::_Exit(written < 0 ? 1 : 0);
    }
    close(ends[1]);
    std::string text;
    std::array<char, 4096> buffer{};
    for (ssize_t n = 0; (n = read(ends[0], buffer.data(), buffer.size())) > 0;) {
      text.append(buffer.data(), static_cast<std::size_t>(n));
    }
    close(ends[0]);
    waitpid(child, nullptr, 0);
    return text;
  }

  // Does the same without the rights of root.
  static std::string as_nobody(const std::function<std::string()>& action) {
    return in_child([&]() -> std::string {
      if (geteuid() == 0 && (setgid(65534) != 0 || setuid(65534) != 0)) return "still root";
      return action();
    });
  }

  std::filesystem::path folder_;
  std::filesystem::path file_;
};

}  // namespace triptych::record
