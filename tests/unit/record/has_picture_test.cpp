// Records contain only the name of a technique, because the library `record` must not depend on the
// catalogue of techniques. Therefore, this test checks that has_picture() and the catalogue agree
// on which techniques draw images.

#include "record/has_picture.hpp"

#include <gtest/gtest.h>

#include "technique/catalogue.hpp"

namespace triptych::record {
namespace {

TEST(HasPicture, AgreesWithTheCatalogue) {
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
