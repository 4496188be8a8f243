#include "technique/volume/quadrature_table.hpp"

#include <gtest/gtest.h>

#include <span>

#include "technique/volume/preintegration.hpp"

namespace triptych::technique {
namespace {

// Returns a function that is 0 up to entry 100, rises linearly to entry 120, and is constant from
// there.
scene::TransferFunction ramp() {
  scene::TransferFunction function;
  for (std::size_t k = 101; k < 256; ++k) {
    const float rise = k < 120 ? static_cast<float>(k - 100) / 20 : 1;
    function.entries[k] = {0.5F, 0.5F, 0.5F, 0.5F * rise};
  }
  function.entries[100] = {0.5F, 0.5F, 0.5F, 0};
  return function;
}

TEST(KinkTable, LeadsToTheNextKinkEitherWay) {
  const QuadratureTable table = kink_table(ramp());
  ASSERT_EQ(table.size(), 257U);
  EXPECT_EQ(table[0][0], 100);
  EXPECT_EQ(table[100][0], 100);
  EXPECT_EQ(table[101][0], 120);
  EXPECT_GT(table[121][0], 1e38F);
  EXPECT_EQ(table[256][1], 120);
  EXPECT_EQ(table[121][1], 120);
  EXPECT_EQ(table[120][1], 100);
  EXPECT_LT(table[100][1], -1e38F);
}

TEST(KinkTable, LeadsToTheNextVisibleEntry) {
  const QuadratureTable table = kink_table(ramp());
  EXPECT_EQ(table[0][2], 101);
  EXPECT_EQ(table[101][2], 101);
  EXPECT_EQ(table[200][2], 200);
  EXPECT_GT(table[256][2], 1e38F);
}

TEST(QuadratureTable, HasTheStatedSize) {
  scene::VolumeScene scene;
  scene.transfer_function = ramp();
  for (const auto quadrature :
       {scene::Quadrature::midpoint, scene::Quadrature::preintegrated, scene::Quadrature::cells}) {
    scene.quadrature = quadrature;
    const QuadratureTable table = quadrature_table(scene);
    EXPECT_EQ(std::as_bytes(std::span(table)).size(), quadrature_table_bytes(quadrature))
        << scene::name_of(quadrature);
  }
}

}  // namespace
}  // namespace triptych::technique
