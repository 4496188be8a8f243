// Replaces RenderDoc and prints when captures begin and end. Implements only the entries of
// RenderDoc's function table that FrameCapture calls.
#include <array>
#include <cstdint>
#include <cstdio>

namespace {

void set_file(const char* file) {
  std::printf("capture to %s\n", file);
  std::fflush(stdout);
}

void begin(void*, void*) {
  std::puts("capture begins");
  std::fflush(stdout);
}

std::uint32_t end(void*, void*) {
  std::puts("capture ends");
  std::fflush(stdout);
  return 1;
}

}  // namespace

extern "C" int RENDERDOC_GetAPI(int version, void** functions) {
  // Indices in the function table of renderdoc_app.h 1.1.2: 11 SetCaptureFilePathTemplate, 19
  // StartFrameCapture, 21 EndFrameCapture.
  static std::array<void*, 23> table{};
  table[11] = reinterpret_cast<void*>(&set_file);
  table[19] = reinterpret_cast<void*>(&begin);
  table[21] = reinterpret_cast<void*>(&end);
  *functions = table.data();
  return version == 10102 ? 1 : 0;
}
