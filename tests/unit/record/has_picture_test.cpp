// A record knows its technique by name alone, and the room sees no catalogue: what both say of
// pictures is held together here.

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
