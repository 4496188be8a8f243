// The anchors are frozen: a time measured years ago is worth nothing beside one of other work.

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "core/hash.hpp"
#include "source_tree.hpp"

namespace triptych::architecture {
namespace {

// What decides an anchor's work: its shape and the text that a device compiles. A new anchor adds
// lines; no line ever changes.
const std::map<std::string, std::string> frozen{
    {"backends/opencl/anchor_arithmetic.cl", "ebda475e5e5b4153c4d5c79d06743fa2"},
    {"backends/opencl/anchor_fetch.cl", "d1513005174ff1eb9f9648ae674570c3"},
    {"backends/opencl/anchor_launch.cl", "953b87a24d14176e0e3b17fde9db21c9"},
    {"backends/opencl/anchor_memory.cl", "4274f13a091f4a02d3a5e3b8ee9236a6"},
    {"src/technique/anchors/anchor_arithmetic.comp.glsl", "25e9efba5ba955f6c3932fca6ada9400"},
    {"src/technique/anchors/anchor_fetch.comp.glsl", "5c68a63756e5890640048c2b4a7f909e"},
    {"src/technique/anchors/anchor_launch.comp.glsl", "a4a4664549cbe3a487358f2473d305e2"},
    {"src/technique/anchors/anchor_memory.comp.glsl", "c25e591882558cc8a2bb30538cfc2806"},
    {"src/technique/anchors/anchor_raster.frag.glsl", "eea97bf1be57dbff5bed43a2882bcc7d"},
    {"src/technique/anchors/anchor_raster.vert.glsl", "85d94e6b473f34ff663700e4af9cb660"},
    {"src/technique/anchors/shape.hpp", "de7657fc5e5dcfdcb218185df359d384"},
};

TEST(Frozen, AnchorsAreTheTextTheyWere) {
  for (const auto& [file, hash] : frozen) {
    EXPECT_EQ(core::content_hash(read(source_folder / file)), hash)
        << file << " is frozen: add a new anchor instead";
  }
}

TEST(Frozen, EveryTextOfAnAnchorIsHeld) {
  std::size_t held = 0;
  for (const char* folder : {"src/technique/anchors", "backends/opencl"}) {
    for (const auto& file : files_below(folder, {".glsl", ".cl"})) {
      const std::string name = std::filesystem::relative(file, source_folder).string();
      if (!file.filename().string().starts_with("anchor_")) continue;
      EXPECT_TRUE(frozen.contains(name)) << name;
      EXPECT_NE(read(file).find("FROZEN"), std::string::npos) << name << " does not say so";
      ++held;
    }
  }
  EXPECT_EQ(held + 1, frozen.size()) << "and the shape";
}

}  // namespace
}  // namespace triptych::architecture
