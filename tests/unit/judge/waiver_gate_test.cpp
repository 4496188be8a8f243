// Tests which findings a waiver excuses, and until when.

#include <gmock/gmock.h>

#include "gate_fixture.hpp"

namespace triptych::judge {
namespace {

using core::ExitCode;

TEST_F(GateTest, AWaiverExcusesUntilItsExpiry) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", wrong_image_on("vulkan:lavapipe"));
  request_.checks = {Check::image};
  write_waivers("2026-03-02");
  const GateResult waived = gate("b");
  EXPECT_EQ(waived.exit_code(), ExitCode::pass) << text(waived);
  ASSERT_EQ(with(waived, Verdict::waived).size(), 1U);
  EXPECT_EQ(with(waived, Verdict::waived).at(0).excuse.reason, "known driver fault");

  write_waivers("2026-03-01");
  const GateResult expired = gate("b");
  EXPECT_EQ(expired.exit_code(), ExitCode::regression);
  const Excuse excuse = with(expired, Verdict::regression).at(0).excuse;
  EXPECT_EQ(excuse.kind, Excuse::Kind::expired);
  EXPECT_EQ(excuse.expiry, "2026-03-01");
}

// The fixture's runs began on 2026-02-01. Setting the clock back must not revive an expired waiver.
TEST_F(GateTest, AClockThatWasSetBackRevivesNoWaiver) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", wrong_image_on("vulkan:lavapipe"));
  request_.checks = {Check::image};
  request_.today = "2025-06-01";
  write_waivers("2026-02-01");
  EXPECT_EQ(gate("b").exit_code(), ExitCode::regression);
  write_waivers("2026-02-02");
  EXPECT_EQ(gate("b").exit_code(), ExitCode::pass);
}

TEST_F(GateTest, AWaivedImagePassesWithAllChecks) {
  accept_first();
  add_run("b", wrong_image_on("vulkan:lavapipe"));
  write_waivers("2027-01-01");
  EXPECT_EQ(gate("b").exit_code(), ExitCode::pass) << text(gate("b"));
}

TEST_F(GateTest, AWaiverForAnotherDeviceExcusesNothing) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", wrong_image_on("vulkan:lavapipe"));
  write_waivers("2027-01-01", "gl:*");
  EXPECT_EQ(gate("b").exit_code(), ExitCode::regression);
}

TEST_F(GateTest, AWaiverForSomeImagesExcusesNoOthers) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", wrong_image_on("vulkan:lavapipe"));
  request_.checks = {Check::image};
  const std::string wrong = with(gate("b"), Verdict::regression).at(0).configuration;
  write_waivers("2027-01-01", "vulkan:*", wrong);
  EXPECT_EQ(gate("b").exit_code(), ExitCode::pass) << text(gate("b"));
  write_waivers("2027-01-01", "vulkan:*", wrong + "0");
  EXPECT_EQ(gate("b").exit_code(), ExitCode::regression);
}

TEST_F(GateTest, AWaiverThatMatchesNothingIsReported) {
  add_run("a");
  (void)accept_run("a");
  write_waivers("2027-01-01", "*", "*", "volume.quick.image.*raycast*");
  EXPECT_EQ(with(gate("a"), Cause::waiver_of_no_test).size(), 1U);
  for (const char* test : {"volume.quick.cost.*", "volume.other.image.x", "*"}) {
    write_waivers("2027-01-01", "vulkan:*", "*", test);
    EXPECT_EQ(with(gate("a"), Cause::waiver_of_no_test).size(), 0U) << test;
  }
}

TEST_F(GateTest, AWaiverOfAPlanThatDoesNotExistIsReported) {
  accept_first();
  request_.known_plans = {"volume/quick", "volume/stress"};
  for (const auto& [test, count] : {std::pair("volume.quik.image.*", 1U),
                                    {"volume.stress.image.*", 0U},
                                    {"volume.quick.image.*", 0U},
                                    {"*.quik.image.*", 0U}}) {
    write_waivers("2027-01-01", "vulkan:*", "*", test);
    const auto found = with(gate("accepted"), Cause::waiver_of_no_plan);
    ASSERT_EQ(found.size(), count) << test;
    if (count == 1) {
      EXPECT_EQ(found[0].fact("plan"), "volume/quik");
    }
  }
  request_.known_plans.clear();
  write_waivers("2027-01-01", "vulkan:*", "*", "volume.quik.image.*");
  EXPECT_EQ(with(gate("accepted"), Cause::waiver_of_no_plan).size(), 0U);
}

// The fault is gone, or a pattern has a typing error.
TEST_F(GateTest, AWaiverThatExcusesNothingIsReported) {
  accept_first();
  add_run("wrong", wrong_image_on("vulkan:lavapipe"));
  write_waivers("2027-01-01");
  EXPECT_EQ(with(gate("wrong"), Cause::unused_waiver).size(), 0U) << text(gate("wrong"));
  const auto unused = with(gate("accepted"), Cause::unused_waiver);
  ASSERT_EQ(unused.size(), 1U) << text(gate("accepted"));
  EXPECT_EQ(unused[0].fact("test"), "volume.quick.image.*");
  EXPECT_EQ(unused[0].number("expired"), 0);
  write_waivers("2027-01-01", "vulkan:*", "*", "volume.quick.*");
  EXPECT_EQ(with(gate("accepted"), Cause::unused_waiver).size(), 1U) << "times have no verdict";
  write_waivers("2027-01-01", "vulkan:*", "*", "volume.quick.timing.*");
  EXPECT_EQ(with(gate("accepted"), Cause::unused_waiver).size(), 0U);
  write_waivers("2027-01-01", "vulkan:*", "*technique=racyast*");
  EXPECT_EQ(with(gate("wrong"), Cause::unused_waiver).size(), 1U) << text(gate("wrong"));
}

// A waiver may still be needed if the run does not cover everything that the waiver names.
TEST_F(GateTest, AWaiverThatMayBeNeededElsewhereIsNotReported) {
  accept_first();
  const auto unused = [&] { return with(gate("accepted"), Cause::unused_waiver).size(); };
  for (const auto& [device, test] : {std::pair("metal:*", "volume.quick.image.*"),
                                     {"vulkan:*", "volume.stress.image.*"},
                                     {"vulkan:*", "*.image.*"}}) {
    write_waivers("2027-01-01", device, "*", test);
    EXPECT_EQ(unused(), 0U) << device << ' ' << test;
  }
  write_waivers("2027-01-01", "*:*");
  EXPECT_EQ(unused(), 1U);
  request_.devices = {"vulkan:*"};
  EXPECT_EQ(unused(), 0U) << "the other accepted devices were not judged";
  request_.devices.clear();
  request_.part = true;
  EXPECT_EQ(unused(), 0U) << "only a part of the plan was judged";
  request_.part = false;
  request_.checks = {Check::image};
  write_waivers("2027-01-01", "vulkan:*", "*", "volume.quick.*");
  EXPECT_EQ(unused(), 0U) << "not all checks were judged";
}

TEST_F(GateTest, AnExpiredWaiverWithoutUseIsReported) {
  add_run("a");
  (void)accept_run("a");
  write_waivers("2025-01-01");
  const GateResult result = gate("a");
  EXPECT_EQ(result.exit_code(), ExitCode::pass);
  ASSERT_EQ(with(result, Cause::unused_waiver).size(), 1U);
  EXPECT_EQ(with(result, Cause::unused_waiver)[0].fact("expiry"), "2025-01-01");
  EXPECT_EQ(with(result, Cause::unused_waiver)[0].number("expired"), 1);
}

TEST_F(GateTest, AWaiverNeedsReasonAndDate) {
  add_run("a");
  (void)accept_run("a");
  for (const char* invalid_date : {"soon", "2099-13-45", "2099-02-29", "0000-00-00"}) {
    write_waivers(invalid_date);
    EXPECT_THROW((void)gate("a"), core::InputError) << invalid_date;
  }
}

// A waiver may last at most a year, so that someone reviews it regularly. The fixture's current
// date is 2026-03-01.
TEST_F(GateTest, AWaiverThatLastsTooLongIsRejected) {
  add_run("a");
  (void)accept_run("a");
  write_waivers("2027-03-02");
  EXPECT_NO_THROW((void)gate("a"));
  for (const char* distant_date : {"2027-03-03", "2099-01-01", "9999-12-31"}) {
    write_waivers(distant_date);
    try {
      (void)gate("a");
      ADD_FAILURE() << distant_date << " was accepted";
    } catch (const core::InputError& error) {
      EXPECT_NE(std::string(error.what()).find("/0/expiry: is more than 366 days after 2026-03-01"),
                std::string::npos)
          << error.what();
    }
  }
}

// If the misspelled key were ignored, the waiver would excuse every configuration.
TEST_F(GateTest, AWaiverWithAMisspelledKeyIsRejected) {
  accept_first();
  write_waivers("2026-12-31");
  const auto file = folder_.path() / "baselines" / "waivers.json";
  std::string text = core::read_text(file);
  text.replace(text.find("\"configuration\""), 15, "\"configurations\"");
  core::write_file(text, file);
  try {
    (void)gate("accepted");
    ADD_FAILURE() << "the misspelled key was accepted";
  } catch (const core::InputError& error) {
    EXPECT_NE(
        std::string(error.what()).find("configurations: unknown key; expected one of: device"),
        std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace triptych::judge
