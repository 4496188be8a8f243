#include "core/foreign_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <new>
#include <stdexcept>

#include "core/error.hpp"

namespace triptych::core {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using testing::ThrowsMessage;

TEST(ForeignError, OurErrorsAreUnchanged) {
  EXPECT_EQ(with_error_context("a.txt", [] { return 7; }), 7);
  EXPECT_THAT([] { with_error_context("a.txt", [] { throw NotSupported("no device"); }); },
              ThrowsMessage<NotSupported>("no device"));
}

TEST(ForeignError, OtherExceptionsAreConvertedAndNameTheFile) {
  const std::map<int, int> none;
  EXPECT_THAT([&] { (void)with_error_context("a.txt", [&] { return none.at(1); }); },
              ThrowsMessage<InputError>(StartsWith("a.txt: cannot be used (map::at")));
  EXPECT_THAT([] { with_error_context("a.txt", [] { throw std::bad_alloc(); }); },
              ThrowsMessage<IoError>("a.txt: not enough memory is available"));
}

TEST(ForeignError, AFileSystemErrorNamesItsOwnFile) {
  const auto fails = [] {
    throw std::filesystem::filesystem_error("status", "b.txt",
                                            std::make_error_code(std::errc::permission_denied));
  };
  EXPECT_THAT([&] { with_error_context("", fails); },
              ThrowsMessage<IoError>("b.txt: Permission denied"));
}

TEST(ForeignError, WithoutAFileItIsAnInternalError) {
  EXPECT_THAT(
      [] { with_error_context("", [] { throw std::logic_error("basic_string::replace"); }); },
      ThrowsMessage<Error>(HasSubstr("internal error in Triptych (basic_string")));
}

}  // namespace
}  // namespace triptych::core
