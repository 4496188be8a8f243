// Tests the table in which `--error` compares devices and techniques.

#include "report/screen/error_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <string>

#include "report/words/requested_error.hpp"

namespace triptych::report {
namespace {

using testing::HasSubstr;
using testing::Not;

class ErrorTableTest : public testing::Test {
 protected:
  measure::ErrorAnswer answer(const std::string& device, double milliseconds,
                              const std::string& scene = "data=ball") {
    record::Record& record = records_.emplace_back();
    record.technique = "raycast";
    record.factors = {{"adapt", "0"},
                      {"ert", "0.0002498626708984375"},
                      {"quadrature", "midpoint"},
                      {"skip", "bricks"},
                      {"step", "0.1484375"}};
    record.counters = {{"samples", 1999}};
    measure::ErrorAnswer answer{.device = device,
                                .scene = scene + ",technique=raycast",
                                .compared_scene = scene,
                                .record = &record,
                                .clock = "wall"};
    answer.errors.by_metric.fill(9e-4);
    answer.empty_image.by_metric.fill(0.9);
    answer.time = record::Summary{.minimum = 1e6 * milliseconds,
                                  .lower_quartile = 1e6 * milliseconds,
                                  .median = 1.1e6 * milliseconds,
                                  .upper_quartile = 1.2e6 * milliseconds,
                                  .maximum = 1.2e6 * milliseconds};
    return answer;
  }

  accuracy::RequestedError request_{.error = 1e-3};
  std::deque<record::Record> records_;
};

TEST_F(ErrorTableTest, NamesTheFastestAndThoseThatMayBeAsFast) {
  const std::string text =
      error_tables({answer("null:a", 50), answer("null:b", 54), answer("null:c", 70)}, request_);
  EXPECT_THAT(text, HasSubstr("\nnull:b  raycast    0.1484  midpoint    0.0002499  bricks  0"));
  EXPECT_THAT(text, HasSubstr("54.000 to 64.800"));
  EXPECT_THAT(text, HasSubstr("\nfastest: null:a with raycast, 55.000 ms (wall clock), error"));
  EXPECT_THAT(text, HasSubstr(": null:b with raycast\n"));
  EXPECT_THAT(text, Not(HasSubstr("null:c with raycast")));
}

TEST_F(ErrorTableTest, HasATableForEachScene) {
  const std::string text =
      error_tables({answer("null:a", 50), answer("null:a", 5, "data=cube")}, request_);
  EXPECT_THAT(text, HasSubstr("data=ball\ndevice"));
  EXPECT_THAT(text, HasSubstr("data=cube\ndevice"));
}

TEST_F(ErrorTableTest, ListsDevicesThatMissTheError) {
  measure::ErrorAnswer missed = answer("null:b", 1);
  missed.record = nullptr;
  missed.time.reset();
  EXPECT_THAT(error_tables({answer("null:a", 50), missed}, request_),
              HasSubstr("null:b data=ball,technique=raycast: no candidate meets the error limit "
                        "0.001:rms; the smallest error is 0.0009\n"));
  EXPECT_THAT(error_tables({missed}, request_), Not(HasSubstr("fastest")));
}

TEST(ErrorWords, NameTheSizeOfAnImage) {
  using Image = measure::Rendering::Image;
  EXPECT_EQ(words::text_of(measure::Rendering{.image = Image::limit, .viewport = "512"}),
            "computing the limit image of 512x512 pixels");
  EXPECT_EQ(words::text_of(measure::Rendering{.image = Image::reference, .viewport = "64x36"}),
            "computing the reference image of 64x36 pixels");
}

}  // namespace
}  // namespace triptych::report
