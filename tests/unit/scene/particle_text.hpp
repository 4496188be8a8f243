#pragma once
// Particle files that a test writes as text.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "core/error.hpp"
#include "scene/particles.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::scene {

using Sphere = std::array<float, 4>;

// Loads a file with this name and text from a temporary folder. `suffix` follows the name, such as
// "@2" for a frame.
inline ParticleSet load(const std::string& name, const std::string& text,
                        ColourKind colour = ColourKind::rgba8, const std::string& suffix = "") {
  const test::TemporaryFolder folder;
  folder.write(name, text);
  return load_particles(name + suffix, colour, {folder.path()});
}

// Expects an error with `place` right after the file's name, and with the text of what was
// expected.
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
