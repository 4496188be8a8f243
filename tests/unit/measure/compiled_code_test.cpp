// Tests parsing of the statistics that drivers print.

#include "measure/code/compiled_code.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "core/error.hpp"
#include "measure/code/capture_stderr.hpp"
#include "measure/code/printed_kernels.hpp"
#include "measure/system/compile_only.hpp"
#include "tests/support/temporary_folder.hpp"

namespace triptych::measure {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Key;
using testing::Not;
using testing::Pair;
using testing::StartsWith;

TEST(ParseStatistics, ReadsRadeonsisLine) {
  const auto read = parse_statistics(
      "Shader Stats: SGPRS: 32 VGPRS: 16 Code Size: 412 LDS: 0 Scratch: 0 Max Waves: 16 "
      "Spilled SGPRs: 3 PrivMem VGPRs: 0 (CS, W32)");
  EXPECT_THAT(read, AllOf(Contains(Pair("SGPRS", 32)), Contains(Pair("VGPRS", 16)),
                          Contains(Pair("Code Size", 412)), Contains(Pair("Max Waves", 16)),
                          Contains(Pair("Spilled SGPRs", 3))));
  EXPECT_EQ(read.size(), 8U);
  EXPECT_THAT(parse_statistics("Code Size: 9204 bytes"), Contains(Pair("Code Size", 9204)));
  EXPECT_THAT(parse_statistics("Shader Disassembly Begin"), IsEmpty());
}

TEST(ParseCounts, ReadsLinesFromIntelAndNvidia) {
  EXPECT_THAT(parse_counts("shader: 55 inst, 0 loops, 328 cycles, 4 sends"),
              AllOf(Contains(Pair("inst", 55)), Contains(Pair("cycles", 328))));
  EXPECT_THAT(parse_counts("ptxas info : Used 32 registers, 8 bytes stack frame"),
              AllOf(Contains(Pair("registers", 32)), Contains(Pair("bytes stack frame", 8))));
}

// The number of waits that LLVM inserts differs from run to run.
TEST(CompiledCode, WaitsCountOnlyIfTheDriverCountsThem) {
  constexpr const char* assembly =
      "BB0_1:\n\timage_sample v1, v[0:2], s[0:7], s[8:11]\n\ts_waitcnt vmcnt(0)\n"
      "\ts_cbranch_scc1 .LBB0_1\n\ts_endpgm\n";
  CompiledCode code;
  code.add("llvm", {{"VGPRS", 8}}, assembly);
  code.add("other waits", {{"VGPRS", 8}}, std::string("\ts_nop 0\n") + assembly);
  code.add("aco", {{"Instructions", 4}}, assembly);
  const Compiled compiled = code.take();
  EXPECT_THAT(compiled.code.at("llvm").statistics,
              AllOf(Contains(Pair("Instructions", 2)), Contains(Pair("Loop instructions", 2)),
                    Not(Contains(Key("Loop waits")))));
  EXPECT_EQ(compiled.code.at("llvm").assembly, compiled.code.at("other waits").assembly);
  EXPECT_NE(compiled.code.at("llvm").assembly, compiled.code.at("aco").assembly);
  EXPECT_THAT(compiled.code.at("aco").statistics,
              AllOf(Contains(Pair("Instructions", 4)), Contains(Pair("Loop instructions", 3)),
                    Contains(Pair("Loop waits", 1))));
}

// Shortened output of rusticl from Mesa 25.0.7.
TEST(PrintedKernels, HaveTheNameThatWasPrintedBefore) {
  const auto kernels = parse_printed_kernels(
      "Shader main disassembly:\ns_endpgm\n*** SHADER STATS ***\nVGPRs: 8\n*****\n"
      "=== Printing nir for 'mm' after spirv_to_nir\n"
      "shader: MESA_SHADER_KERNEL\n"
      "=== Printing nir variant 'Default' for 'mm' before driver finalization\n"
      "Shader main disassembly:\nmain:\n\tv_mov_b32 v0, 1\n\ts_endpgm\n"
      "*** SHADER STATS ***\nSGPRS: 24\nVGPRS: 12\nCode Size: 128 bytes\nMax Waves: 16\n"
      "********************\n\n"
      "=== Printing nir variant 'Default' for 'zz' before driver finalization\n"
      "=== Printing nir variant 'Optimized' for 'zz' before driver finalization\n"
      "Shader main disassembly:\n\ts_endpgm\n*** SHADER STATS ***\nVGPRS: 16\n*****\n"
      "Shader main disassembly:\n\ts_nop 0\n\ts_endpgm\n*** SHADER STATS ***\nVGPRS: 20\n*****\n");
  ASSERT_EQ(kernels.size(), 3U);
  EXPECT_EQ(kernels[0].name, "mm");
  EXPECT_EQ(kernels[0].assembly, "main:\n\tv_mov_b32 v0, 1\n\ts_endpgm\n");
  EXPECT_THAT(kernels[0].statistics,
              testing::UnorderedElementsAre(Pair("SGPRS", 24), Pair("VGPRS", 12),
                                            Pair("Code Size", 128), Pair("Max Waves", 16)));
  EXPECT_EQ(kernels[1].name, "zz");
  EXPECT_EQ(kernels[2].name, "zz (optimized)");
  EXPECT_THAT(kernels[2].statistics, testing::ElementsAre(Pair("VGPRS", 20)));
}

TEST(PrintedKernels, EmptyOutputContainsNoKernels) {
  EXPECT_THAT(parse_printed_kernels(""), IsEmpty());
  EXPECT_THAT(parse_printed_kernels("DRM_IOCTL_GET_CAP: unhandled 0x10\n"), IsEmpty());
}

TEST(CompiledCode, HashesAreNotStatistics) {
  CompiledCode code;
  code.add("a", {{"VGPRs", 24}, {"Driver pipeline hash", 1e18}, {"Hash", 7}}, "");
  const Compiled compiled = code.take();
  EXPECT_THAT(compiled.code.at("a").statistics, testing::ElementsAre(Pair("VGPRs", 24)));
}

TEST(CompiledCode, TheSameNameTwiceIsTwoExecutables) {
  CompiledCode code;
  code.add("cull.comp", {{"VGPRs", 24}}, "");
  code.add("cull.comp", {{"VGPRs", 28}}, "");
  EXPECT_THAT(code.take().code, AllOf(Contains(Key("cull.comp")), Contains(Key("cull.comp#2"))));
}

TEST(CompiledCode, NothingReportedIsNotSupported) {
  CompiledCode code;
  code.add("a", {}, "");
  EXPECT_THROW(static_cast<void>(code.take()), core::NotSupported);
}

// Two drivers for the same GPU: the first reports the number of instructions. For the second, the
// instructions are counted in the disassembly.
TEST(CompiledCode, CountsInstructionsThatAreNotReported) {
  const std::string assembly = "BB0:\n\tv_mov_b32 v0, 0\n\ts_endpgm\n";
  CompiledCode code;
  code.add("counted", {{"VGPRs", 24}}, assembly);
  code.add("reported", {{"Instructions", 60}}, assembly);
  const Compiled compiled = code.take();
  EXPECT_EQ(compiled.code.at("counted").statistics.at("Instructions"), 1);
  EXPECT_EQ(compiled.code.at("reported").statistics.at("Instructions"), 60);
  EXPECT_EQ(compiled.listings.at(compiled.code.at("counted").assembly), assembly);
}

TEST(StandardError, IsCapturedAndReturned) {
  const auto write = [](const std::string& text) {
    ASSERT_EQ(::write(STDERR_FILENO, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  };
  EXPECT_EQ(capture_stderr([&] { write("from a driver\n"); }), "from a driver\n");
  EXPECT_EQ(capture_stderr([] {}), "");
}

// Rust's runtime writes to the file descriptor, whereas Mesa writes single words to the C stream
// stderr.
TEST(StandardError, KeepsTheOrderOfWritesToTheStreamAndTheDescriptor) {
  const std::string both = capture_stderr([] {
    for (const char* word : {"shader: ", "a ", "kernel\n"}) std::fputs(word, stderr);
    ASSERT_EQ(::write(STDERR_FILENO, "a name\n", 7), 7);
    std::fputs("last", stderr);
  });
  EXPECT_EQ(both, "shader: a kernel\na name\nlast");
}

TEST(CompileOnly, FamiliesAreReadFromIds) {
  EXPECT_EQ(compile_only("vulkan:radv-navi31")->family, "navi31");
  EXPECT_EQ(compile_only("opencl:rusticl-navi31")->driver, "rusticl");
  for (const char* id : {"vulkan:radv", "gl:radeonsi-egl", "vulkan:lavapipe", "vulkan:radv-*"}) {
    EXPECT_FALSE(compile_only(id)) << id;
  }
}

TEST(CompileOnly, AnotherDeviceNeedsNoVariables) {
  EXPECT_THAT(compile_only_environment("vulkan:lavapipe"), IsEmpty());
  EXPECT_THAT(compile_only_environment("vulkan:radv"), IsEmpty());
}

TEST(CompileOnly, AMissingDriverIsReportedWithItsPackage) {
  const std::vector<std::string> nowhere{"LD_LIBRARY_PATH=/nowhere"};
  try {
    static_cast<void>(compile_only_environment("vulkan:nvk-pascal", nowhere));
    FAIL() << "no stub has this family";
  } catch (const core::NotSupported& error) {
    EXPECT_THAT(std::string(error.what()), Not(IsEmpty()));
  }
}

// Mesa 26.1 removed RADV_FORCE_FAMILY, the variable that selects a GPU family. Since then, RADV
// needs a stub that imitates the kernel's interface to a GPU.
TEST(CompileOnly, RadvUsesTheStubIfItsVariableHasBeenRemoved) {
  const test::TemporaryFolder folder;
  const std::string icd =
      folder.write("radeon_icd.json", fmt::format(R"({{"ICD": {{"library_path": "{}"}}}})",
                                                  (folder.path() / "libradv.so").string()));
  const std::string stub = folder.write("libamdgpu_noop_drm_shim.so", "");
  const std::vector<std::string> overrides{"VK_DRIVER_FILES=" + icd,
                                           "LD_LIBRARY_PATH=" + folder.path().string()};
  static_cast<void>(folder.write("libradv.so", "RADV_FORCE_FAMILY"));
  const auto older = compile_only_environment("vulkan:radv-navi31", overrides);
  EXPECT_THAT(older, Contains("RADV_FORCE_FAMILY=navi31"));
  EXPECT_THAT(older, Not(Contains("AMDGPU_GPU_ID=navi31")));
  static_cast<void>(folder.write("libradv.so", "RADV_FORCE_FAMILY=<family> has been removed."));
  const auto newer = compile_only_environment("vulkan:radv-navi31", overrides);
  EXPECT_THAT(newer, Not(Contains("RADV_FORCE_FAMILY=navi31")));
  EXPECT_THAT(newer, IsSupersetOf({std::string("AMDGPU_GPU_ID=navi31"), "LD_PRELOAD=" + stub}));
}

// The name of a compile-only device must be the same on every machine.
TEST(CompileOnly, NamesDoNotContainTheKernelVersion) {
  EXPECT_EQ(without_kernel_version(
                "AMD Radeon RX 6800 (radeonsi, navi21, LLVM 19.1.7, DRM 3.49, 6.12.1-amd64)"),
            "AMD Radeon RX 6800 (radeonsi, navi21, LLVM 19.1.7)");
  EXPECT_EQ(without_kernel_version("NVK Ampere"), "NVK Ampere");
  EXPECT_EQ(without_kernel_version("cut off, DRM 3.49"), "cut off, DRM 3.49");
}

}  // namespace
}  // namespace triptych::measure
