// Records contain only the name of a technique, because the library `record` must not depend on the
// catalogue of techniques. Therefore, this test checks that has_image() and the catalogue agree
// on which techniques draw images.

#include "record/has_image.hpp"

#include <gtest/gtest.h>

#include "technique/catalogue.hpp"

namespace triptych::record {
namespace {

TEST(HasImage, AgreesWithTheCatalogue) {
  std::size_t without = 0;
  for (const technique::Technique& each : technique::catalogue()) {
    Record record;
    record.technique = each.id;
    EXPECT_EQ(has_image(record), each.draws_image) << each.id;
    without += each.draws_image ? 0 : 1;
  }
  EXPECT_EQ(without, 1U);
}

}  // namespace
}  // namespace triptych::record
