#include "report/page/history_page.hpp"

#include <gmock/gmock.h>

#include "core/json.hpp"

namespace triptych::report {
namespace {

using testing::HasSubstr;
using testing::Not;

// Returns the history page for the stores d0/gate.sqlite, d1/gate.sqlite, …, with these times.
std::string page_of(const std::vector<double>& times) {
  core::Json points = core::Json::array();
  for (const double time : times) {
    const std::string name = "d" + std::to_string(points.size()) + "/gate.sqlite";
    points.push_back({{"store", "/stores/" + name},
                      {"name", name},
                      {"started_at", ""},
                      {"driver_version", ""},
                      {"changes", ""},
                      {"worse", false},
                      {"time", time}});
  }
  return history_page(core::Json::array({{{"device", "gl:x"}, {"points", points}}}));
}

// A change of 0.02 % must not look like a step.
TEST(HistoryPage, DoesNotMagnifyNoise) {
  EXPECT_THAT(page_of({1, 1.0002}), HasSubstr(">1.01<"));
  EXPECT_THAT(page_of({1, 1.5}), Not(HasSubstr(">1.01<")));
}

TEST(HistoryPage, GivesAllDevicesTheSameAxis) {
  const auto device = [](const char* name, double time) {
    const core::Json point{{"store", "s"},         {"name", "s"},   {"started_at", ""},
                           {"driver_version", ""}, {"changes", ""}, {"worse", false},
                           {"time", time}};
    return core::Json{{"device", name}, {"points", core::Json::array({point})}};
  };
  const std::string page = history_page(core::Json::array({device("gl:x", 1), device("gl:y", 3)}));
  const std::size_t second = page.find("<h2>gl:y");
  for (const char* tick : {">1<", ">2<", ">3<"}) {
    EXPECT_LT(page.find(tick), second) << tick;
    EXPECT_NE(page.find(tick, second), std::string::npos) << tick;
  }
}

TEST(HistoryPage, NamesStoresAsTheHistoryDoes) {
  const std::string page = page_of({1, 1.5});
  EXPECT_THAT(page, HasSubstr("<td>d1/gate.sqlite</td>"));
  EXPECT_THAT(page, Not(HasSubstr(">gate.sqlite<")));
}

}  // namespace
}  // namespace triptych::report
