// A record knows its technique by name alone, and judge sees no catalogue: what both say of anchors
// is held together here.

#include <gtest/gtest.h>

#include "judge/timing/anchor.hpp"
#include "technique/catalogue.hpp"

namespace triptych {
namespace {

TEST(AnchorRecord, IsOneOfATechniqueWithoutAPicture) {
  std::size_t anchors = 0;
  for (const technique::Technique& each : technique::catalogue()) {
    record::Record record;
    record.technique = each.id;
    record.suite = each.suite;
    EXPECT_EQ(judge::is_anchor(record), !each.picture) << each.id;
    anchors += each.picture ? 0 : 1;
  }
  EXPECT_GT(anchors, 1U);
}

}  // namespace
}  // namespace triptych
