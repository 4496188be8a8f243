#include "core/error.hpp"

#include <gtest/gtest.h>

#include <type_traits>

namespace triptych::core {
namespace {

TEST(InputError, NamesFileLineAndColumn) {
  const InputError error({.file = "plan.yaml", .line = 3, .column = 7}, "unknown factor");
  EXPECT_STREQ(error.what(), "plan.yaml:3:7: unknown factor");
  EXPECT_EQ(error.place().line, 3);
}

TEST(InputError, OmitsUnknownParts) {
  EXPECT_STREQ(InputError({.file = "a.nrrd"}, "empty").what(), "a.nrrd: empty");
  EXPECT_STREQ(InputError({.file = "a.nrrd", .line = 2}, "bad").what(), "a.nrrd:2: bad");
  EXPECT_STREQ(InputError("no place").what(), "no place");
  EXPECT_STREQ(InputError(FilePlace{}, "no place").what(), "no place");
}

TEST(ApiError, NamesCallCodeAndPlace) {
  const auto here = core::CodePlace::current();
  const ApiError error("clFinish", "CL_OUT_OF_RESOURCES", "after the kernel", here);
  const std::string text = error.what();
  EXPECT_EQ(text, "clFinish returned CL_OUT_OF_RESOURCES at error_test.cpp:" +
                      std::to_string(here.line()) + ": after the kernel");
  EXPECT_EQ(error.call(), "clFinish");
  EXPECT_EQ(error.code(), "CL_OUT_OF_RESOURCES");
}

// All errors of a configuration are caught in one place. Therefore, they must all derive from
// Error, and a lost device must count as an API error.
TEST(Errors, AllDeriveFromError) {
  static_assert(std::is_base_of_v<Error, InputError>);
  static_assert(std::is_base_of_v<Error, IoError>);
  static_assert(std::is_base_of_v<Error, NotSupported>);
  static_assert(std::is_base_of_v<ApiError, DeviceLost>);
  EXPECT_THROW(throw DeviceLost("vkQueueSubmit", "VK_ERROR_DEVICE_LOST"), ApiError);
}

}  // namespace
}  // namespace triptych::core
