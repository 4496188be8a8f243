#pragma once
// Particle files that a case writes as text.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "core/error.hpp"
#include "scene/particles.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::scene {

using Sphere = std::array<float, 4>;

// Of a file of this name in a folder where names are looked for; `suffix` goes behind its name.
inline ParticleSet load(const std::string& name, const std::string& text,
                        ColourKind colour = ColourKind::rgba8, const std::string& suffix = "") {
  const test::TemporaryFolder folder;
  folder.write(name, text);
  return load_particles(name + suffix, colour, {folder.path()});
}

// With `place` right behind the file's name, and saying what was expected.
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
