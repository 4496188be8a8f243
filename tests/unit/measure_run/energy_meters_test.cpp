#include "measure/system/energy_meters.hpp"

#include <dlfcn.h>
#include <gmock/gmock.h>

#include <chrono>
#include <optional>
#include <thread>

#include "core/file.hpp"
#include "core/temporary_folder.hpp"
#include "measure/protocol/protocol.hpp"
#include "measure/system/stopwatch.hpp"
#include "tests/unit/measure_run/scripted_prepared.hpp"

namespace triptych::measure {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

constexpr const char* no_nvml = "no such library";

// Imitates the folders in which Linux exposes energy meters.
class EnergyMetersTest : public ::testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) const {
    const std::filesystem::path path = system_.path() / "class" / file;
    std::filesystem::create_directories(path.parent_path());
    core::write_file(text + "\n", path);
  }
  void zone(const std::string& folder, const std::string& name, const std::string& energy) const {
    write("powercap/" + folder + "/name", name);
    write("powercap/" + folder + "/energy_uj", energy);
    write("powercap/" + folder + "/max_energy_range_uj", "10000");
  }
  [[nodiscard]] EnergyMeters meters() const { return EnergyMeters(system_.path(), no_nvml); }

  core::TemporaryFolder system_;
};

// Sleeps long enough for ten calls to last a tenth of a second.
void take_a_while() {
  std::this_thread::sleep_for(std::chrono::milliseconds(12));
}

TEST_F(EnergyMetersTest, WithoutMetersNothingIsReportedOrDrawn) {
  EXPECT_THAT(meters().names(), IsEmpty());
  EXPECT_THAT(meters().energy_per_frame([] { ADD_FAILURE() << "a frame was drawn"; }), IsEmpty());
}

TEST_F(EnergyMetersTest, DuplicateAndUnreadableMetersAreIgnored) {
  zone("intel-rapl:0", "package-0", "1");
  zone("intel-rapl:0/intel-rapl:0:0", "core", "1");
  zone("intel-rapl:0/intel-rapl:0:1", "dram", "1");
  zone("intel-rapl:1", "psys", "1");
  zone("intel-rapl-mmio:0", "package-0", "1");
  // An empty file represents a meter that only root can read.
  zone("intel-rapl:2", "package-1", "");
  // In virtual machines, the meter always reads 0.
  zone("intel-rapl:3", "package-2", "0");
  write("hwmon/hwmon0/name", "coretemp");
  write("hwmon/hwmon0/energy1_input", "1");
  write("hwmon/hwmon1/name", "xe");
  write("hwmon/hwmon1/energy1_input", "1");
  write("hwmon/hwmon2/name", "xe");
  EXPECT_THAT(meters().names(), ElementsAre("package-0", "package-0/dram", "xe-0"));
}

// The meter is updated only every third frame. Energy before its first or after its last update
// must not be counted.
TEST_F(EnergyMetersTest, CountsBetweenMeterUpdates) {
  zone("intel-rapl:0", "package-0", "1000");
  int drawn = 0;
  std::optional<Stopwatch> since_the_first;
  const record::Counts energy = meters().energy_per_frame([&] {
    take_a_while();
    ++drawn;
    if (drawn % 3 == 2) {
      if (!since_the_first) since_the_first.emplace();
      zone("intel-rapl:0", "package-0", std::to_string(1000 + 90 * drawn));
    }
  });
  EXPECT_THAT(energy, ElementsAre(Pair("package-0", 90)));
  ASSERT_TRUE(since_the_first);
  EXPECT_GE(since_the_first->ns(), 100e6);
}

TEST_F(EnergyMetersTest, ACounterMayWrap) {
  zone("intel-rapl:0", "package-0", "9000");
  int drawn = 0;
  const record::Counts energy = meters().energy_per_frame([&] {
    take_a_while();
    zone("intel-rapl:0", "package-0", std::to_string((9000 + 300 * ++drawn) % 10000));
  });
  EXPECT_THAT(energy, ElementsAre(Pair("package-0", 300)));
}

// The meter of an Intel GPU does not state its largest value. If its value falls, the energy since
// the previous update is unknown, so neither the energy nor the frames of that interval may count.
TEST_F(EnergyMetersTest, AMeterWithoutRangeThatIsResetStartsAgain) {
  write("hwmon/hwmon1/name", "xe");
  write("hwmon/hwmon1/energy1_input", "9000");
  int drawn = 0;
  const record::Counts energy = meters().energy_per_frame([&] {
    take_a_while();
    ++drawn;
    write("hwmon/hwmon1/energy1_input", std::to_string((drawn < 5 ? 9000 : 0) + 300 * drawn));
  });
  EXPECT_THAT(energy, ElementsAre(Pair("xe-0", 300)));
  EXPECT_GT(drawn, 5);
}

TEST_F(EnergyMetersTest, AMeterThatDoesNotChangeIsIgnoredAfterASecond) {
  zone("intel-rapl:0", "package-0", "1000");
  zone("intel-rapl:1", "package-1", "1000");
  int drawn = 0;
  const record::Counts energy = meters().energy_per_frame([&] {
    take_a_while();
    zone("intel-rapl:0", "package-0", std::to_string(1000 + ++drawn));
  });
  EXPECT_THAT(energy, ElementsAre(Pair("package-0", 1)));
  EXPECT_LE(drawn, 84);
}

TEST_F(EnergyMetersTest, TwoLongFramesAreEnough) {
  zone("intel-rapl:0", "package-0", "1000");
  int drawn = 0;
  const record::Counts energy = meters().energy_per_frame([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(520));
    zone("intel-rapl:0", "package-0", std::to_string(1000 + 7 * ++drawn));
  });
  EXPECT_EQ(drawn, 2);
  EXPECT_THAT(energy, ElementsAre(Pair("package-0", 7)));
}

TEST_F(EnergyMetersTest, NvidiaMetersReportMillijoules) {
  const EnergyMeters meters(system_.path(), FAKE_NVML);
  EXPECT_THAT(meters.names(), ElementsAre("nvidia-0"));
  void* library = ::dlopen(FAKE_NVML, RTLD_NOW);
  ASSERT_NE(library, nullptr);
  const auto take =
      reinterpret_cast<void (*)(unsigned long long)>(::dlsym(library, "fake_nvml_take"));
  const record::Counts energy = meters.energy_per_frame([&] {
    take_a_while();
    take(3);
  });
  EXPECT_THAT(energy, ElementsAre(Pair("nvidia-0", 3000)));
}

TEST_F(EnergyMetersTest, RecordsOfTimedLoopsContainEnergy) {
  zone("intel-rapl:0", "package-0", "1000");
  const EnergyMeters meters = this->meters();
  int drawn = 0;
  const auto energy_of = [&](const Protocol& protocol) {
    ScriptedPrepared prepared([&](int) {
      take_a_while();
      zone("intel-rapl:0", "package-0", std::to_string(1000 + 20 * ++drawn));
      return frame_of(12e6);
    });
    return measure(prepared, protocol, technique::Work::compute, {}, "test", &meters).record.energy;
  };
  EXPECT_THAT(energy_of({}), ElementsAre(Pair("package-0", 20)));
  EXPECT_THAT(energy_of(brief_protocol), IsEmpty());
  EXPECT_THAT(energy_of({.timed = false}), IsEmpty());
}

}  // namespace
}  // namespace triptych::measure
