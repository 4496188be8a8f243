#include "record/short_name.hpp"

#include <gtest/gtest.h>

namespace triptych::record {
namespace {

const std::string key =
    "camera=orbit_y:1/8,data=generate:mandelbulb:96,step=0.5,technique=raycast,"
    "transfer_function=surfaces,viewport=192";

TEST(ShortName, ContainsLevelsThatAreNotDefaults) {
  EXPECT_EQ(short_name("volume", "volume/quick", key),
            "volume.quick.raycast.mandelbulb_96.surfaces.orbit_y_1_8.s0_5.v192");
  EXPECT_EQ(short_name(key), "raycast.mandelbulb_96.surfaces.orbit_y_1_8.s0_5.v192");
  EXPECT_EQ(short_name("volume", "mine", "data=bonsai.nrrd,technique=raycast"),
            "volume.mine.raycast.bonsai");
}

TEST(ShortName, NamesOtherFactors) {
  EXPECT_EQ(short_name("data=stress:widest,ert=0,skip=none,technique=tiles"),
            "tiles.widest.ert_0.skip_none");
}

TEST(ShortName, DistinguishesWhatItCannotSpell) {
  EXPECT_NE(short_name("data=a b.nrrd"), short_name("data=a_b.nrrd"));
  EXPECT_NE(short_name("data=x/bonsai.nrrd"), short_name("data=y/bonsai.nrrd"));
  EXPECT_NE(short_name("step=-1"), short_name("step=1"));
  EXPECT_EQ(short_name("data=ribosome.cif.gz"), "ribosome");
  EXPECT_EQ(short_name("data=x.raw:64x64x64:u8"), "x_64x64x64_u8");
}

TEST(ShortName, GlobsMatchNamesAndKeys) {
  for (const char* glob :
       {"volume.quick.*.surfaces.*", "raycast.mandelbulb_96.*", "*step=0.5*", key.c_str(),
        "volume.quick.raycast.mandelbulb_96.surfaces.orbit_y_1_8.s0_5.v192"}) {
    EXPECT_TRUE(names_configuration(glob, "volume", "volume/quick", key)) << glob;
  }
  for (const char* glob : {"volume.cost.*", "mandelbulb_96", "*haze*"}) {
    EXPECT_FALSE(names_configuration(glob, "volume", "volume/quick", key)) << glob;
  }
}

}  // namespace
}  // namespace triptych::record
