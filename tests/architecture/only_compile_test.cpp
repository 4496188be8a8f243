// Tests that compile-only devices (drivers that compile code for GPUs that this machine lacks)
// execute nothing. In each backend, all calls that submit, draw or read back are in a single place,
// which rejects them for such devices.

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "source_tree.hpp"

namespace triptych::architecture {
namespace {

// Returns the files of a backend in which a line matches, ignoring comments.
std::set<std::string> files_with(const std::string& folder, const std::regex& pattern) {
  std::set<std::string> found;
  for (const auto& file : files_below(folder, {".cpp", ".hpp"})) {
    std::istringstream text(read(file));
    for (std::string line; std::getline(text, line);) {
      if (std::regex_search(line.substr(0, line.find("//")), pattern)) {
        found.insert(std::filesystem::path(file).filename().string());
      }
    }
  }
  return found;
}

TEST(OnlyCompile, VulkanSubmitsInOnePlace) {
  EXPECT_EQ(files_with("backends/vulkan", std::regex(R"(queue\.(submit|waitIdle))")),
            std::set<std::string>{"gpu.cpp"});
}

TEST(OnlyCompile, OpenclHasOneQueue) {
  EXPECT_EQ(files_with("backends/opencl", std::regex(R"(cl::CommandQueue|\bclEnqueue\w+\()")),
            (std::set<std::string>{"device.cpp", "objects.hpp"}));
}

// Every GL function that this backend calls to execute work, read results or wait must be replaced
// on compile-only devices.
TEST(OnlyCompile, GlReplacesAllExecutingCalls) {
  const std::string guard = read(source_folder / "backends/gl/compile_only.cpp");
  static const std::regex call(
      R"(\bgl_?(?:->|\.)((?:Draw(?:Arrays|Elements)|MultiDraw|Dispatch|Clear|Read(?!Buffer)|Copy|Get\w*SubData|GetQueryObject|GetTexImage|FenceSync|ClientWaitSync|Finish|Flush|Blit|BufferSubData|BufferData|TexImage|TexSubImage|GenerateMipmap|MapBuffer)\w*)\()");
  std::size_t seen = 0;
  for (const auto& file : files_below("backends/gl", {".cpp", ".hpp"})) {
    const std::string text = read(file);
    for (std::sregex_iterator at(text.begin(), text.end(), call), end; at != end; ++at) {
      const std::string name = (*at)[1];
      ++seen;
      EXPECT_NE(guard.find("gl." + name), std::string::npos)
          << file << " calls gl" << name << ", which compile_only.cpp does not replace";
    }
  }
  EXPECT_GT(seen, 10U);
}

}  // namespace
}  // namespace triptych::architecture
