#pragma once
// Runs triptych with a scripted device and keeps what it said.

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "support/temporary_folder.hpp"

namespace triptych::command_line {

struct Result {
  int code = -1;
  std::string output;  // both streams
};

// In a folder of its own; `script` is the null backend's.
class Program {
 public:
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }
  void write(const std::string& name, std::string_view text) const {
    static_cast<void>(folder_.write(name, text));
  }

  // `arguments` as a shell reads them, in the folder; `wrapper` goes before the program.
  [[nodiscard]] Result run(const std::string& arguments, const std::string& script = "{}",
                           const std::string& wrapper = "") const {
    const std::string command = "cd '" + folder().string() + "' && TRIPTYCH_NULL_SCRIPT='" +
                                script + "' TRIPTYCH_DATA= " + wrapper +
                                " '" TRIPTYCH_PROGRAM "' " + arguments + " 2>&1";
    FILE* pipe = ::popen(command.c_str(), "r");
    if (pipe == nullptr) throw std::runtime_error("cannot start " + command);
    Result result;
    std::array<char, 4096> bytes{};
    while (const std::size_t got = std::fread(bytes.data(), 1, bytes.size(), pipe)) {
      result.output.append(bytes.data(), got);
    }
    const int status = ::pclose(pipe);
    result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return result;
  }

 private:
  test::TemporaryFolder folder_;
};

// A plan of one small scene on the scripted device.
inline constexpr const char* tiny =
    "--device 'null:*' --set technique=raycast --set data=generate:gaussian_blob:16 "
    "--set transfer_function=haze --set viewport=16";

}  // namespace triptych::command_line
