// A record knows its technique only by name, because this room cannot use the catalogue. This test
// compares which techniques draw images according to each of them.

#include "record/has_picture.hpp"

#include <gtest/gtest.h>

#include "technique/catalogue.hpp"

namespace triptych::record {
namespace {

TEST(HasPicture, IsWhatTheCatalogueSays) {
  std::size_t without = 0;
  for (const technique::Technique& each : technique::catalogue()) {
    Record record;
    record.technique = each.id;
    EXPECT_EQ(has_picture(record), each.picture) << each.id;
    without += each.picture ? 0 : 1;
  }
  EXPECT_EQ(without, 1U);
}

}  // namespace
}  // namespace triptych::record
