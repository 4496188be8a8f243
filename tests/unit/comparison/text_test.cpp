#include "comparison/text.hpp"

#include <gmock/gmock.h>

namespace triptych::comparison {
namespace {

using testing::HasSubstr;

record::Device device(std::string id, std::map<std::string, std::string> environment = {}) {
  return {.id = std::move(id),
          .driver_version = "Mesa 1",
          .api_version = "1.3",
          .cpu_features = "avx avx2",
          .environment = std::move(environment)};
}

std::string sides_of(const record::Device& a, const record::Device& b) {
  ComparisonResult result;
  result.a = a;
  result.b = b;
  return to_text(result, {.plan = "volume/quick", .sides = "", .varied = {}});
}

TEST(ComparisonText, TellsOnceWhatBothSidesHave) {
  const record::Device plain = device("vulkan:x");
  EXPECT_THAT(sides_of(plain, plain),
              HasSubstr("a: vulkan:x; driver Mesa 1; API 1.3\nb: the same\n"));
  EXPECT_THAT(sides_of(plain, device("gl:y")), HasSubstr("b: gl:y; driver Mesa 1; API 1.3\n"));
  record::Device other = plain;
  other.cpu_features = "avx";
  EXPECT_THAT(sides_of(plain, other),
              HasSubstr("API 1.3; CPU avx avx2\nb: the same, but CPU avx\n"));
}

TEST(ComparisonText, NamesTheVariablesOfASide) {
  const record::Device plain = device("vulkan:x");
  const record::Device one = device("vulkan:x", {{"WIDTH", "128"}});
  EXPECT_THAT(sides_of(plain, one), HasSubstr("b: the same, but WIDTH=128\n"));
  EXPECT_THAT(sides_of(one, plain),
              HasSubstr("API 1.3; WIDTH=128\nb: the same, but without WIDTH=128\n"));
  EXPECT_THAT(sides_of(one, device("vulkan:x", {{"WIDTH", "256"}})),
              HasSubstr("WIDTH=128\nb: the same, but WIDTH=256\n"));
}

}  // namespace
}  // namespace triptych::comparison
