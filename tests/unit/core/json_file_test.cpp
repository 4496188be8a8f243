#include "core/json_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <functional>

#include "core/error.hpp"
#include "core/file.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::core {
namespace {

using testing::HasSubstr;

class JsonFileTest : public testing::Test {
 protected:
  JsonFile read(std::string_view text) {
    core::write_file(text, folder_.path() / "file.json");
    return *JsonFile::read(folder_.path() / "file.json");
  }
  // Returns the error that `use` throws for this JSON input.
  core::InputError error_of(std::string_view text,
                            const std::function<void(const JsonNode&)>& use) {
    try {
      const JsonFile file = read(text);
      use(file.root());
    } catch (const core::InputError& error) {
      return error;
    }
    return core::InputError("no error");
  }

  TemporaryFolder folder_;
};

TEST_F(JsonFileTest, MissingFileIsNotAnError) {
  EXPECT_FALSE(JsonFile::read(folder_.path() / "absent.json").has_value());
}

TEST_F(JsonFileTest, BrokenSyntaxHasLineAndColumn) {
  const auto error = error_of("{\n \"a\": 1,\n \"b\": nul\n}\n", [](const JsonNode&) {});
  EXPECT_EQ(error.place().line, 3);
  EXPECT_GE(error.place().column, 7);
  EXPECT_THAT(error.what(), HasSubstr("file.json:3:"));
  EXPECT_THAT(error.what(), HasSubstr("syntax error"));
}

TEST_F(JsonFileTest, TruncatedFileEndsOnItsLastLine) {
  EXPECT_EQ(error_of("{\n \"a\": {\n", [](const JsonNode&) {}).place().line, 3);
}

TEST_F(JsonFileTest, ANumberThatIsTooLargeHasItsLine) {
  const auto error = error_of("{\n \"a\": 1,\n \"b\": 1e999\n}\n", [](const JsonNode&) {});
  EXPECT_EQ(error.place().line, 3);
  EXPECT_THAT(error.what(), HasSubstr("the number 1e999 is too large"));
}

TEST_F(JsonFileTest, APipeIsNotWaitedFor) {
  const auto file = folder_.path() / "pipe.json";
  ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
  EXPECT_THAT([&] { static_cast<void>(JsonFile::read(file)); },
              testing::ThrowsMessage<core::IoError>(HasSubstr("is a pipe or a device")));
}

TEST_F(JsonFileTest, KeyTwiceInOneObjectIsAnError) {
  const auto error = error_of("{\n \"x\": {\"a\": 1},\n \"y\": {\"a\": 1,\n  \"a\": 2}\n}\n",
                              [](const JsonNode&) {});
  EXPECT_EQ(error.place().line, 4);
  EXPECT_THAT(error.what(), HasSubstr("'a' appears twice"));
}

TEST_F(JsonFileTest, WrongTypeHasLineAndPath) {
  const auto error =
      error_of("{\n \"one\": {\"v\": 1},\n \"two\": {\"v\": -3}\n}\n", [](const JsonNode& root) {
        for (const auto& [name, node] : root.members()) {
          (void)node.at("v").whole_number();
        }
      });
  EXPECT_EQ(error.place().line, 3);
  EXPECT_THAT(error.what(), HasSubstr("at /two/v: expected a whole number, 0 or more, found -3"));
}

TEST_F(JsonFileTest, EveryAccessorChecksItsType) {
  const auto expect = [&](std::string_view message,
                          const std::function<void(const JsonNode&)>& use) {
    EXPECT_THAT(error_of("{\"a\": [1.5]}", use).what(), HasSubstr(message));
  };
  expect("'b' is missing", [](const JsonNode& n) { (void)n.at("b"); });
  expect("expected a string", [](const JsonNode& n) { (void)n.at("a").text(); });
  expect("expected an array", [](const JsonNode& n) { (void)n.elements(); });
  expect("expected an object", [](const JsonNode& n) { (void)n.at("a").members(); });
  expect("expected a positive number", [](const JsonNode& n) { (void)n.positive_number(); });
  expect("at /a/0: expected a whole number",
         [](const JsonNode& n) { (void)n.at("a").elements()[0].whole_number(); });
}

TEST(JsonLines, OneValuePerLine) {
  const core::Json value = {{"b", {{"x", 1}, {"y", {1, 2}}}}, {"a", core::Json::object()}};
  EXPECT_EQ(to_lines(value, 2), "{\n \"a\": {},\n \"b\": {\n  \"x\": 1,\n  \"y\": [1,2]\n }\n}\n");
  EXPECT_EQ(core::Json::parse(to_lines(value, 1)), value);
}

TEST(JsonLines, InvalidUtf8DoesNotStopTheWriter) {
  EXPECT_NO_THROW((void)to_lines(core::Json("driver \xff"), 1));
}

}  // namespace
}  // namespace triptych::core
