// Tests that the shader source declares conservative depth exactly when the option is on. The image
// cannot show this, because a driver that ignores the declaration draws the same image.
#include <gmock/gmock.h>

#include <memory>
#include <string>

#include "backends/gl/context.hpp"
#include "backends/gl/particle_source.hpp"
#include "core/error.hpp"

namespace triptych::gl_backend {
namespace {

using technique::ParticleFault;
using testing::HasSubstr;
using testing::Not;

std::unique_ptr<Context> any_context() {
  for (const auto& candidates : {&egl_candidates, &osmesa_candidates}) {
    try {
      for (const Candidate& candidate : candidates()) return candidate.open(false);
    } catch (const core::Error&) {
      continue;  // the caller skips the test if no context can be opened
    }
  }
  return nullptr;
}

TEST(ConservativeDepth, IsDeclaredExactlyWhenItIsOn) {
  const auto context = any_context();
  if (context == nullptr) GTEST_SKIP() << "no OpenGL context can be created";
  const Current current(*context);
  const auto pixel_stage = [&](const ParticleConstants& constants) {
    return particle_stages(context->gl(), constants,
                           {{GL_FRAGMENT_SHADER, {"sphere.frag.glsl"}, {}}})
        .front()
        .source;
  };
  const std::string declared = "\nlayout(TRI_DEPTH_PROMISE) out float gl_FragDepth;\n";
  const std::string less = "#define TRI_DEPTH_PROMISE depth_less\n";
  const std::string greater = "#define TRI_DEPTH_PROMISE depth_greater\n";
  const std::string off = pixel_stage({.conservative_depth = false});
  EXPECT_THAT(off, Not(HasSubstr("#define TRI_DEPTH_PROMISE")));
  EXPECT_THAT(off, Not(HasSubstr("depth_less")));
  EXPECT_THAT(off, Not(HasSubstr("depth_greater")));
  const std::string on = pixel_stage({.conservative_depth = true});
  EXPECT_THAT(on, HasSubstr(declared));
  EXPECT_THAT(on, HasSubstr(less));
  EXPECT_THAT(on, Not(HasSubstr(greater)));
  const std::string injected =
      pixel_stage({.conservative_depth = true, .fault = ParticleFault::wrong_sense});
  EXPECT_THAT(injected, HasSubstr(greater));
  EXPECT_THAT(injected, Not(HasSubstr(less)));
}

}  // namespace
}  // namespace triptych::gl_backend
