#pragma once
// A temporary folder for stores, and helpers that interfere with a store from other processes.

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

// Creates a store with one run and one record.
inline void make_store(const std::filesystem::path& file) {
  Store store(file, Store::Mode::append);
  store.add_run(sample_run());
  store.add_record(sample_record());
}

inline std::vector<std::byte> bytes_of(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

// Mounts a 1 MiB disk that only this process sees. Needs no root privileges if users may create
// namespaces.
inline bool mount_small_disk(const std::filesystem::path& folder) {
  const uid_t user = geteuid();
  const gid_t group = getegid();
  if (unshare(CLONE_NEWNS) != 0) {
    if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
    std::ofstream("/proc/self/uid_map") << "0 " << user << " 1";
    // Files cannot be created on the disk while the group has no number in the new namespace. The
    // kernel accepts a group map only after setgroups(2) was forbidden.
    std::ofstream("/proc/self/setgroups") << "deny";
    std::ofstream("/proc/self/gid_map") << "0 " << group << " 1";
  }
  return mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
         mount("none", folder.c_str(), "tmpfs", 0, "size=1m") == 0;
}

// Limits the size of every file that this process writes from now on.
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
    // Gives other users access, because some tests drop root privileges. (For root, nothing is
    // read-only.)
    std::filesystem::permissions(folder_, std::filesystem::perms::all);
    // The name contains characters that must be escaped in SQLite URIs.
    file_ = folder_ / "a store?#%.sqlite";
  }
  ~StoreTest() override {
    std::filesystem::permissions(folder_, std::filesystem::perms::all);
    std::filesystem::remove_all(folder_);
  }

  // Runs `action` in a child process. Returns its result, or the message of its exception.
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

  // Runs `action` in a child process without root privileges.
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
