// Tests that Triptych also runs on machines without drivers, on which libraries are missing.
#include "backends/gl/library.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"

namespace triptych::gl_backend {
namespace {

using testing::HasSubstr;

TEST(Library, AMissingLibraryIsReportedWithTheLoadersReason) {
  try {
    const Library library{"libtriptych-no-such.so.1", "libtriptych-no-such.so"};
    ADD_FAILURE() << "opened";
  } catch (const core::NotSupported& error) {
    EXPECT_THAT(error.what(), HasSubstr("libtriptych-no-such.so.1"));
  }
}

TEST(Library, TheFirstExistingLibraryIsOpened) {
  const Library library{"libtriptych-no-such.so.1", "libc.so.6"};
  EXPECT_NE(library.find<void (*)()>("malloc"), nullptr);
}

TEST(Library, AMissingFunctionIsNullOrAnError) {
  const Library library{"libc.so.6"};
  EXPECT_EQ(library.find<void (*)()>("triptych_no_such_function"), nullptr);
  try {
    static_cast<void>(library.get<void (*)()>("triptych_no_such_function"));
    ADD_FAILURE() << "found";
  } catch (const core::NotSupported& error) {
    EXPECT_STREQ(error.what(), "libc.so.6 lacks the function triptych_no_such_function");
  }
}

}  // namespace
}  // namespace triptych::gl_backend
