#pragma once
// Helpers for tests that write particle files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "core/error.hpp"
#include "scene/particles.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::scene {

using Sphere = std::array<float, 4>;

// Writes `text` to a file in a temporary folder and loads it. `suffix` is appended to the name when
// loading, for example "@2" to select a frame.
inline ParticleSet load(const std::string& name, const std::string& text,
                        ColourKind colour = ColourKind::rgba8, const std::string& suffix = "") {
  const test::TemporaryFolder folder;
  folder.write(name, text);
  return load_particles(name + suffix, colour, {folder.path()});
}

// Expects that loading fails, with a message that contains `place` right after the file's name and
// also contains `expectation`.
inline void expect_refused(const std::string& name, const std::string& text,
                           const std::string& place, const std::string& expectation,
                           const std::string& suffix = "") {
  using testing::HasSubstr;
  SCOPED_TRACE(text);
  EXPECT_THAT([&] { load(name, text, ColourKind::rgba8, suffix); },
              testing::ThrowsMessage<core::InputError>(
                  testing::AllOf(HasSubstr(name + place), HasSubstr(expectation))));
}

}  // namespace triptych::scene
