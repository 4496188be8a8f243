// Tests `triptych history`, which compares the stores of several days in chronological order.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>
#include <thread>

#include "core/json.hpp"
#include "correct_image.hpp"
#include "program.hpp"

namespace triptych::command_line {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class History : public testing::Test {
 protected:
  // `base_ns` is the time of a frame. `keys` contains additional keys for the script.
  void measure(const std::string& store, const std::string& base_ns, const std::string& keys = "",
               const std::string& how = "") const {
    const std::string script = fmt::format(R"({{"images": {{"*": "{}"}}, "base_ns": {}{}}})",
                                           image_file.string(), base_ns, keys);
    const Result result =
        program.run(fmt::format("run volume/quick --store {} {} {}", store, tiny,
                                how.starts_with("--set") ? how : "--set skip=none,bricks " + how),
                    script);
    ASSERT_EQ(result.code, 0) << result.output;
  }

  Program program;
  std::filesystem::path image_file = correct_image(program);
};

TEST_F(History, ReportsChangesAndTheFirstStoreThatIsWorse) {
  measure("1.sqlite", "1e5");
  measure("2.sqlite", "2e5");
  measure("3.sqlite", "2e5", R"(, "failures": [{"kind": "wrong_image", "at": "image"}])");
  measure("4.sqlite", "2e5", R"(, "failures": [{"kind": "wrong_image", "at": "image"}])");
  const Result printed = program.run("history 1.sqlite 2.sqlite 3.sqlite 4.sqlite --json");
  ASSERT_EQ(printed.code, 0) << printed.output;
  const core::Json history = core::Json::parse(printed.output).at(0);
  EXPECT_EQ(history.at("device"), "null:scripted");
  const core::Json& points = history.at("points");
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(points[0].at("time"), 1.0);
  EXPECT_NEAR(points[1].at("time").get<double>(), 2, 0.2);
  EXPECT_FALSE(points[1].at("worse").get<bool>()) << "times are shown, not judged";
  EXPECT_FALSE(points[1].contains("cost")) << "an uncounted cost must be absent rather than 1";
  EXPECT_TRUE(points[2].at("worse").get<bool>());
  EXPECT_FALSE(points[3].at("worse").get<bool>()) << "no worse than the previous store";
  EXPECT_THAT(history.at("first_worse").get<std::string>(), HasSubstr("3.sqlite"));
}

// In the second store, the device clock reports only a tenth of the wall time, so it is not
// trusted. The frames take the same time as in the first store.
TEST_F(History, ComparesTimesFromTheSameClock) {
  measure("1.sqlite", "1e5", R"(, "device_over_wall": 0.91)");
  measure("2.sqlite", "1e5", R"(, "device_over_wall": 0.1)");
  measure("3.sqlite", "2e5", R"(, "device_over_wall": 0.91)");
  const Result printed = program.run("history 1.sqlite 2.sqlite 3.sqlite --json");
  const core::Json points = core::Json::parse(printed.output).at(0).at("points");
  ASSERT_EQ(points.size(), 3U);
  EXPECT_NEAR(points[1].at("time").get<double>(), 1, 0.05);
  EXPECT_NEAR(points[2].at("time").get<double>(), 2, 0.2);
  // The frames take the same time in every run, so only a real change is distinguishable from
  // noise.
  EXPECT_FALSE(points[0].contains("time_change"));
  EXPECT_TRUE(points[1].at("time_change").at("noise").get<bool>());
  EXPECT_FALSE(points[2].at("time_change").at("noise").get<bool>());
  EXPECT_GT(points[1].at("time_change").at("half_width").get<double>(), 0);
  // The clock differs in the second store, and again in the third.
  EXPECT_FALSE(points[0].contains("changed_clocks"));
  EXPECT_TRUE(points[1].contains("changed_clocks"));
  EXPECT_TRUE(points[2].contains("changed_clocks"));
  const Result screen = program.run("history 1.sqlite 2.sqlite 3.sqlite");
  EXPECT_THAT(screen.output, HasSubstr("(noise)"));
  EXPECT_THAT(screen.output, HasSubstr("triptych compare"));
}

// The second store has images but no times.
TEST_F(History, ContinuesAfterAGap) {
  const std::string wrong = R"(, "failures": [{"kind": "wrong_image", "at": "image"}])";
  measure("1.sqlite", "1e5");
  measure("2.sqlite", "1e5", "", "--untimed");
  measure("3.sqlite", "2e5", wrong);
  const Result printed = program.run("history 1.sqlite 2.sqlite 3.sqlite --json");
  const core::Json points = core::Json::parse(printed.output).at(0).at("points");
  ASSERT_EQ(points.size(), 3U);
  EXPECT_FALSE(points[1].contains("time"));
  EXPECT_NEAR(points[2].at("time").get<double>(), 2, 0.2);
  EXPECT_TRUE(points[2].at("worse").get<bool>());
}

// The second store has only one of the two configurations. The other configuration is wrong in the
// third store.
TEST_F(History, ComparesEachConfigurationWithThePreviousStoreThatHasIt) {
  const std::string wrong =
      R"(, "failures": [{"kind": "wrong_image", "at": "image", "only": "*skip=bricks*"}])";
  measure("1.sqlite", "1e5");
  measure("2.sqlite", "1e5", "", "--set skip=none");
  measure("3.sqlite", "1e5", wrong);
  measure("4.sqlite", "1e5", wrong);
  const Result printed = program.run("history 1.sqlite 2.sqlite 3.sqlite 4.sqlite --json");
  const core::Json points = core::Json::parse(printed.output).at(0).at("points");
  ASSERT_EQ(points.size(), 4U);
  EXPECT_FALSE(points[1].at("worse").get<bool>());
  EXPECT_TRUE(points[2].at("worse").get<bool>()) << printed.output;
  EXPECT_FALSE(points[3].at("worse").get<bool>());
}

TEST_F(History, DistinguishesStoresWithTheSameName) {
  for (const char* store : {"d1/gate.sqlite", "d2/gate.sqlite", "other.sqlite"}) {
    measure(store, "1e5");
  }
  const Result printed =
      program.run("history d1/gate.sqlite d2/gate.sqlite ./other.sqlite --out history.html");
  const std::string page = program.read("history.html");
  for (const std::string& text : {printed.output, page}) {
    EXPECT_THAT(text, AllOf(HasSubstr("d1/gate.sqlite"), HasSubstr("d2/gate.sqlite")));
    EXPECT_THAT(text, Not(HasSubstr("./other.sqlite")));
  }
}

TEST_F(History, OrdersStoresByTime) {
  measure("b.sqlite", "1e5");
  // The start time of a run has a resolution of one second, so the second run must begin at least
  // one second later.
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  measure("a.sqlite", "1e5");
  const Result printed = program.run("history a.sqlite b.sqlite");
  ASSERT_EQ(printed.code, 0) << printed.output;
  EXPECT_LT(printed.output.find("b.sqlite"), printed.output.find("a.sqlite")) << printed.output;
  EXPECT_THAT(printed.output, Not(HasSubstr("first store that is worse")));
}

TEST_F(History, ReportsInjectedFaults) {
  measure("1.sqlite", "1e5");
  measure("2.sqlite", "1e5", "", "--inject slowdown:50");
  const Result printed = program.run("history 1.sqlite 2.sqlite --out history.html");
  for (const std::string& text : {printed.output, program.read("history.html")}) {
    EXPECT_THAT(text, HasSubstr(" [injected: slowdown:50]"));
  }
}

TEST_F(History, WritesAPage) {
  measure("1.sqlite", "1e5");
  measure("2.sqlite", "1e5", R"(, "failures": [{"kind": "wrong_image", "at": "image"}])");
  ASSERT_EQ(program.run("history 1.sqlite 2.sqlite --out history.html").code, 0);
  const std::string page = program.read("history.html");
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_THAT(page, HasSubstr("First store that is worse"));
  // The only script on the page saves figures, and the page must allow no other script.
  const std::size_t script = page.find("<script>");
  EXPECT_NE(script, std::string::npos);
  EXPECT_EQ(page.find("<script", script + 1), std::string::npos);
  EXPECT_THAT(page, HasSubstr("script-src 'sha256-"));
  const Result json = program.run("history 1.sqlite 2.sqlite --json --out history.html");
  EXPECT_TRUE(core::Json::accept(json.output)) << json.output;
}

TEST_F(History, RejectsMissingStoresAndOverwriting) {
  measure("1.sqlite", "1e5");
  EXPECT_EQ(program.run("history nothing.sqlite").code, 2);
  const Result over = program.run("history 1.sqlite --out 1.sqlite");
  EXPECT_EQ(over.code, 3);
  EXPECT_THAT(over.output, HasSubstr("names the same file as STORE"));
  const Result none = program.run("history 1.sqlite --device 'vulkan:*'");
  EXPECT_EQ(none.code, 2) << none.output;
}

}  // namespace
}  // namespace triptych::command_line
