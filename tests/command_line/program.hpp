#pragma once
// Runs triptych with a scripted device of the null backend, whose times, images and failures are
// given by a script. Returns the output of triptych.

#include <string>

#include "support/command.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::command_line {

using test::Result;

// Runs the program in its own folder. `script` is the script of the null backend.
class Program {
 public:
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }
  void write(const std::string& name, std::string_view text) const {
    static_cast<void>(folder_.write(name, text));
  }
  [[nodiscard]] std::string read(const std::string& name) const { return folder_.read(name); }

  // Runs the program in that folder, through a shell that parses `arguments`. `wrapper` is a
  // command that is put before the program.
  [[nodiscard]] Result run(const std::string& arguments, const std::string& script = "{}",
                           const std::string& wrapper = "") const {
    return test::run_command("cd '" + folder().string() + "' && TRIPTYCH_NULL_SCRIPT='" + script +
                             "' TRIPTYCH_DATA= " + wrapper + " '" TRIPTYCH_PROGRAM "' " +
                             arguments);
  }

 private:
  test::TemporaryFolder folder_;
};

// Options that select one small scene on the scripted device.
inline constexpr const char* tiny =
    "--device 'null:*' --set technique=raycast --set data=generate:gaussian_blob:16 "
    "--set transfer_function=haze --set viewport=16";

// A plan file with the same scene. More factors may be appended.
inline constexpr const char* tiny_plan =
    "suite: volume\ntechnique: [raycast]\ndata: [generate:gaussian_blob:16]\n"
    "transfer_function: [haze]\nviewport: [16]\n";

}  // namespace triptych::command_line
