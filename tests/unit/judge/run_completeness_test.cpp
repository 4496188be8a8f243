// Tests that an incomplete run, a machine that lost a device, and a plan that lost a check do not
// pass.

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include "core/file.hpp"
#include "gate_fixture.hpp"

namespace triptych::judge {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::SizeIs;
using testing::StartsWith;

const std::vector<std::string> all_devices{"gl:llvmpipe-egl", "opencl:pocl", "vulkan:lavapipe"};

class RunCompletenessTest : public GateTest {
 protected:
  RunCompletenessTest() { checks_ = {Check::image, Check::counters}; }

  void begin(const std::string& run, record::RunStart begun = {}) {
    if (begun.devices.empty()) begun.devices = all_devices;
    if (begun.found.empty()) begun.found = all_devices;
    begun.host = "host1";
    store_.begin(run, begun, configurations_);
  }
  // Adds a run whose beginning is recorded as `begun`.
  void add_planned_run(const std::string& run, const record::RunStart& begun = {}) {
    add_run(run);
    begin(run, begun);
  }
  void accept_planned_run() {
    add_planned_run("accepted");
    static_cast<void>(accept_run("accepted"));
  }
  void execute_sql(const std::string& sql) {
    SQLite::Database(store_.file().string(), SQLite::OPEN_READWRITE).exec(sql);
  }
  void write_absent(const std::string& text) {
    core::write_file(text, folder_.path() / "baselines" / "absent.json");
  }
  // Returns the findings that could not be judged, each as "DEVICE CAUSE NAMES".
  static std::vector<std::string> undecided_lines(const GateResult& result) {
    std::vector<std::string> lines;
    for (const Finding& each : with(result, Verdict::cannot_judge)) {
      lines.push_back(
          fmt::format("{} {} {}", each.device, name_of(each.cause), fmt::join(each.names, ";")));
    }
    return lines;
  }

  std::vector<std::string> configurations_{plain_, bricks_,
                                           "camera=side,data=ball,technique=raycast",
                                           "camera=side,data=ball,skip=bricks,technique=raycast"};
};

TEST_F(RunCompletenessTest, ACompleteRunPasses) {
  accept_planned_run();
  add_planned_run("run");
  EXPECT_EQ(gate("run").exit_code(), core::ExitCode::pass) << text(gate("run"));
}

// The run was interrupted after the first device had been completed.
TEST_F(RunCompletenessTest, ADeviceThatWasNotReachedIsReported) {
  accept_planned_run();
  add_planned_run("run");
  execute_sql("DELETE FROM record WHERE run = 'run' AND device <> 'gl:llvmpipe-egl'");
  execute_sql("DELETE FROM device WHERE run = 'run' AND id <> 'gl:llvmpipe-egl'");
  const GateResult result = gate("run");
  EXPECT_EQ(result.exit_code(), core::ExitCode::cannot_judge);
  EXPECT_THAT(undecided_lines(result),
              IsSupersetOf({StartsWith("opencl:pocl missing " + bricks_),
                            StartsWith("vulkan:lavapipe missing " + bricks_)}));
}

TEST_F(RunCompletenessTest, AConfigurationThatWasNotReachedIsReportedWithoutThePlan) {
  accept_planned_run();
  add_planned_run("run");
  request_.part = true;  // so that accepted configurations do not count as missing
  execute_sql("DELETE FROM record WHERE run = 'run' AND configuration = '" + plain_ + "'");
  EXPECT_THAT(undecided_lines(gate("run")), Contains("opencl:pocl missing " + plain_));
}

TEST_F(RunCompletenessTest, ALostDeviceDescriptionIsReported) {
  accept_planned_run();
  add_planned_run("run");
  execute_sql("DELETE FROM device WHERE run = 'run' AND id = 'opencl:pocl'");
  EXPECT_THAT(undecided_lines(gate("run")), Contains(StartsWith("opencl:pocl no_description")));
}

TEST_F(RunCompletenessTest, ShorteningTheListOfPlannedConfigurationsIsDetected) {
  add_planned_run("run");
  add_run("short");
  configurations_.erase(configurations_.begin());
  begin("short");
  execute_sql("DELETE FROM planned WHERE run = 'run' AND configuration = '" + plain_ + "'");
  const auto refusal = [&]() -> std::string {
    try {
      static_cast<void>(gate("run"));
    } catch (const core::InputError& error) {
      return error.what();
    }
    return "was judged";
  };
  EXPECT_THAT(refusal(), HasSubstr("the list of configurations of run 'run' was changed"));
  // Somebody who also changes the hash of the list breaks the seal of the run.
  execute_sql("CREATE TABLE kept AS SELECT * FROM run");
  for (const char* change : {"planned_hash = (SELECT planned_hash FROM kept WHERE id = 'short')",
                             "planned_hash = ''", "begun = '[]'"}) {
    execute_sql(fmt::format("UPDATE run SET {} WHERE id = 'run'", change));
    EXPECT_THAT(refusal(), testing::AllOf(HasSubstr("run 'run' was changed"),
                                          testing::Not(HasSubstr("the list"))))
        << change;
    execute_sql(
        "UPDATE run SET (planned_hash, begun) = (SELECT planned_hash, begun FROM kept WHERE "
        "kept.id = run.id)");
  }
}

TEST_F(RunCompletenessTest, ARunThatWasCutShortIsNotAccepted) {
  add_planned_run("run");
  execute_sql("DELETE FROM record WHERE run = 'run' AND device = 'opencl:pocl'");
  EXPECT_THROW(static_cast<void>(accept_run("run")), core::InputError);
  EXPECT_NO_THROW(static_cast<void>(accept_run("run", {.drop = true})));
}

TEST_F(RunCompletenessTest, TheReasonForAnUnmeasuredRequiredDeviceIsReported) {
  accept_planned_run();
  const std::string package = "install the package mesa-drm-shim";
  const record::Reason aborted{.cause = record::Cause::signal, .numbers = {{"signal", 6}}};
  add_planned_run("run", {.unusable = {{"gl:radeonsi-navi31", package},
                                       {"vulkan:radv-nosuch", "unknown family", aborted}}});
  request_.required_devices = {"gl:radeonsi-navi31", "vulkan:radv-nosuch"};
  const std::vector<Finding> found = with(gate("run"), Verdict::cannot_judge);
  ASSERT_EQ(found.size(), 2U) << text(gate("run"));
  EXPECT_EQ(found[0].cause, Cause::no_required_device);
  EXPECT_EQ(found[0].detail, package);
  EXPECT_EQ(found[1].cause, Cause::no_required_device);
  EXPECT_EQ(found[1].reason, aborted);
}

// If a driver crashes during device enumeration, the run contains nothing about its device. Here,
// the first device is missing. The other devices show that the run comes from a kind of machine for
// which the missing device was accepted.
TEST_F(RunCompletenessTest, AMissingDeviceOfThisKindOfMachineCannotBeJudged) {
  accept_planned_run();
  const record::RunStart without_gl{.found = {all_devices[1], all_devices[2]},
                                    .devices = {all_devices[1], all_devices[2]}};
  add_planned_run("run", without_gl);
  execute_sql("DELETE FROM record WHERE run = 'run' AND device = 'gl:llvmpipe-egl'");
  execute_sql("DELETE FROM device WHERE run = 'run' AND id = 'gl:llvmpipe-egl'");
  const GateResult result = gate("run");
  EXPECT_EQ(result.exit_code(), core::ExitCode::cannot_judge);
  EXPECT_THAT(undecided_lines(result), Contains(StartsWith("gl:llvmpipe-egl device_missing")));

  GateRequest excused = request_;
  excused.without_devices = {"gl:*"};
  EXPECT_EQ(gate("run", excused).exit_code(), core::ExitCode::pass) << text(gate("run", excused));
  write_absent(R"([{"device": "gl:*", "host": "host?", "reason": "no EGL"}])");
  EXPECT_EQ(gate("run").exit_code(), core::ExitCode::pass) << text(gate("run"));
  write_absent(R"([{"device": "gl:*", "host": "other", "reason": "no EGL"}])");
  EXPECT_EQ(gate("run").exit_code(), core::ExitCode::cannot_judge);
  write_absent(R"([{"device": "gl:*", "reason": "no EGL", "expiry": "2026-02-28"}])");
  EXPECT_EQ(gate("run").exit_code(), core::ExitCode::cannot_judge);
  // This entry expired before the run, which began on 2026-02-01. It must not become valid again,
  // although the clock has been set back since then.
  write_absent(R"([{"device": "gl:*", "reason": "no EGL", "expiry": "2026-01-31"}])");
  request_.today = "2025-06-01";
  EXPECT_EQ(gate("run").exit_code(), core::ExitCode::cannot_judge);
  write_absent(R"([{"device": "*", "reason": "all"}])");
  EXPECT_THROW(static_cast<void>(gate("run")), core::InputError);
}

// Devices do not count as missing if the machine has none of the accepted driver versions, or if
// the run requested only some devices.
TEST_F(RunCompletenessTest, OtherMachinesNeedNotHaveTheDevice) {
  accept_planned_run();
  const record::RunStart vulkan_only{
      .requested = {"vulkan:*"}, .found = {all_devices[2]}, .devices = {all_devices[2]}};
  add_planned_run("asked", vulkan_only);
  execute_sql("DELETE FROM record WHERE run = 'asked' AND device <> 'vulkan:lavapipe'");
  execute_sql("DELETE FROM device WHERE run = 'asked' AND id <> 'vulkan:lavapipe'");
  EXPECT_THAT(undecided_lines(gate("asked")), IsEmpty());
  for (const std::string& id : all_devices) driver_versions_[id] = "99";
  const record::RunStart newer{.found = {all_devices[2]}, .devices = {all_devices[2]}};
  add_planned_run("newer", newer);
  execute_sql("DELETE FROM record WHERE run = 'newer' AND device <> 'vulkan:lavapipe'");
  execute_sql("DELETE FROM device WHERE run = 'newer' AND id <> 'vulkan:lavapipe'");
  EXPECT_THAT(undecided_lines(gate("newer")), testing::Not(Contains(HasSubstr("device_missing"))));
}

TEST_F(RunCompletenessTest, AFailedListingCannotBeJudgedAndIsShown) {
  accept_planned_run();
  const record::Unusable crashed{"vulkan", "", record::Reason{.cause = record::Cause::signal}};
  const record::Unusable refused{"OpenCL platform X", "it reports no devices", {}};
  add_planned_run("run",
                  {.found = all_devices, .devices = all_devices, .unusable = {crashed, refused}});
  const GateResult result = gate("run");
  EXPECT_THAT(undecided_lines(result), Contains(StartsWith(" listing_failed")));
  EXPECT_THAT(result.unusable, SizeIs(2));
  request_.without_devices = {"vulkan"};
  EXPECT_EQ(gate("run").exit_code(), core::ExitCode::pass);
  request_.without_devices.clear();
  add_planned_run("others", {.requested = {"gl:*", "opencl:*"},
                             .found = all_devices,
                             .devices = all_devices,
                             .unusable = {crashed}});
  // This run requested no Vulkan devices.
  EXPECT_EQ(gate("others").exit_code(), core::ExitCode::pass);
  // If a run names a device in full and finds it, no device can be missing. If it names devices by
  // a glob, some devices may be missing.
  for (const bool whole : {true, false}) {
    const std::string run = whole ? "named" : "glob";
    add_planned_run(run, {.requested = {whole ? "vulkan:lavapipe" : "vulkan:*"},
                          .found = all_devices,
                          .devices = all_devices,
                          .unusable = {crashed}});
    EXPECT_EQ(gate(run).exit_code(), whole ? core::ExitCode::pass : core::ExitCode::cannot_judge);
  }
}

TEST_F(RunCompletenessTest, APlanThatLostAcceptedChecksCannotBeJudged) {
  accept_planned_run();
  checks_ = {Check::counters};
  add_planned_run("run");
  const GateResult result = gate("run");
  EXPECT_EQ(result.exit_code(), core::ExitCode::cannot_judge);
  EXPECT_THAT(undecided_lines(result), Contains(" checks_lost image"));
  static_cast<void>(accept_run("run"));
  EXPECT_EQ(gate("run").exit_code(), core::ExitCode::pass) << text(gate("run"));
}

TEST_F(RunCompletenessTest, InjectedFaultsAreCountedWhateverTheVerdict) {
  accept_planned_run();
  add_run("run", [](record::Record& record, core::Image&) {
    if (record.device == "opencl:pocl") record.injected = "slowdown";
  });
  begin("run");
  EXPECT_EQ(gate("run").injected, (std::map<std::string, std::size_t>{{"slowdown", 4}}));
}

// The manifest describes the other files, so it must agree with their content.
TEST_F(RunCompletenessTest, AManifestThatContradictsItsFilesIsDamaged) {
  accept_planned_run();
  const std::string whole = folder_.read(baseline("manifest.json"));
  const auto changed = [&](const auto& change) {
    core::Json manifest = core::Json::parse(whole);
    change(manifest);
    core::write_file(manifest.dump(1), baseline("manifest.json"));
    return Baselines(folder_.path() / "baselines", plan).problem();
  };
  EXPECT_EQ(changed([](core::Json&) {}), "");
  EXPECT_THAT(changed([](core::Json& json) { json["devices"].erase("opencl:pocl"); }),
              HasSubstr("does not list"));
  EXPECT_THAT(changed([](core::Json& json) { json["devices"]["gl:llvmpipe-egl"] = {"gl-other"}; }),
              HasSubstr("does not list"));
  EXPECT_THAT(changed([](core::Json& json) { json["files"]["../x"] = "0"; }),
              HasSubstr("is outside the folder"));
  EXPECT_THAT(changed([](core::Json& json) { json["configurations"] = 3; }),
              HasSubstr("gives the number of configurations as 3, but counters.json contains 4"));
  // These entries of the manifest cannot be checked against another file. Therefore the history of
  // accepted baselines contains the hash of the manifest.
  for (const char* name : {"plan_hash", "checks"}) {
    EXPECT_THAT(changed([&](core::Json& json) { json[name] = "memory"; }),
                HasSubstr("is not the most recently accepted manifest"))
        << name;
  }
  EXPECT_THAT(changed([](core::Json& json) { json["machines"] = core::Json::array(); }),
              HasSubstr("is not the most recently accepted manifest"));
  EXPECT_EQ(changed([](core::Json&) {}), "");
}

// A device, driver or check that was deleted from the manifest still has a file.
TEST_F(RunCompletenessTest, EveryFileThatTheManifestDoesNotDescribeIsReported) {
  accept_planned_run();
  const std::string manifest = folder_.read(baseline("manifest.json"));
  const auto problem = [&] { return Baselines(folder_.path() / "baselines", plan).problem(); };
  const std::string counters = folder_.read(baseline("counters.json"));
  core::Json more = core::Json::parse(counters);
  more[plain_]["samples"]["gl:unknown"] = 1;
  for (const auto& [file, content, expected] : std::vector<std::array<std::string, 3>>{
           {"cost/gl-unknown.json", "{}", "does not list cost/gl-unknown.json"},
           {"code/gl-unknown.json", "{}", "does not list code/gl-unknown.json"},
           {"statistics/gl-unknown.json", "{}", "does not list statistics/gl-unknown.json"},
           {"lacking.json", R"({"gl-unknown": ["x"]})",
            "the driver gl-unknown, although lacking.json contains it"},
           {"memory.json", R"({"x": {"gl:unknown": {"buffers": 1}}})",
            "the device gl:unknown, although memory.json contains it"},
           {"counters.json", more.dump(1),
            "the device gl:unknown, although counters.json contains it"},
           {"accuracy.json", "{}", "the check accuracy, although accuracy.json exists"},
           {"score.json", "{}", "the check stress, although score.json exists"}}) {
    std::filesystem::create_directories(baseline(file).parent_path());
    rewrite(file, content);
    EXPECT_THAT(problem(), HasSubstr(expected));
    std::filesystem::remove(baseline(file));
    core::write_file(counters, baseline("counters.json"));
    core::write_file(manifest, baseline("manifest.json"));
    EXPECT_EQ(problem(), "");
  }
  core::Json machines = core::Json::parse(manifest);
  machines["machines"][0].push_back("gl-unknown");
  core::write_file(machines.dump(1), baseline("manifest.json"));
  EXPECT_THAT(problem(), HasSubstr("the driver gl-unknown for any device, but lists it for"));
}

// If a configuration were lost from counters.json, nobody would notice that it is also missing from
// a run.
TEST_F(RunCompletenessTest, AConfigurationLostFromTheBaselinesIsReported) {
  accept_planned_run();
  core::Json counters = core::Json::parse(folder_.read(baseline("counters.json")));
  counters.erase(plain_);
  rewrite("counters.json", counters.dump(1));
  EXPECT_THAT(Baselines(folder_.path() / "baselines", plan).problem(),
              HasSubstr("gives the number of configurations as 4, but counters.json contains 3"));
}

// If a later run failed before it was added to the store, the latest run in the store is an older
// one. The gate must then report the date of that run. The fixture's runs began on 2026-02-01.
TEST_F(RunCompletenessTest, AnOldRunIsReportedWithItsDate) {
  add_planned_run("run");
  for (const auto& [today, began] : {std::pair{"2026-02-01", ""},
                                     {"2026-02-02", ""},
                                     {"2026-02-03", "2026-02-01"},
                                     {"2027-02-01", "2026-02-01"},
                                     {"2026-01-01", ""}}) {
    request_.today = today;
    EXPECT_EQ(gate("run").old_run_date, began) << today;
  }
}

// The run was begun by one build of Triptych and resumed by another.
TEST_F(RunCompletenessTest, EveryProgramThatMeasuredIsCompared) {
  request_.program = "1, commit b";
  add_planned_run("run", {.program = "1, commit b", .devices = {"gl:llvmpipe-egl"}});
  EXPECT_EQ(gate("run").measured_by, "");
  begin("run", {.program = "1, commit a", .devices = {"opencl:pocl"}});
  EXPECT_EQ(gate("run").measured_by, "1, commit a; judged by 1, commit b");
}

TEST_F(RunCompletenessTest, AWaiverThatMatchesEverythingIsRejected) {
  accept_planned_run();
  add_planned_run("run");
  for (const char* glob : {"*", "**", "?*"}) {
    write_waivers("2026-12-31", glob, "*", "*");
    EXPECT_THROW(static_cast<void>(gate("run")), core::InputError) << glob;
  }
  write_waivers("2026-12-31", "*", "*", "volume.quick.image.*");
  EXPECT_NO_THROW(static_cast<void>(gate("run")));
  write_waivers("2026-12-31", "gl:*", "*", "*");
  EXPECT_NO_THROW(static_cast<void>(gate("run")));
  // These globs match everything, because every device id contains a colon, every configuration an
  // equals sign, and every test id at least two dots.
  write_waivers("2026-12-31", "*:*", "*=*", "*.*.*");
  EXPECT_THROW(static_cast<void>(gate("run")), core::InputError);
  write_absent(R"([{"device": "*:*", "reason": "all"}])");
  EXPECT_THROW(static_cast<void>(gate("run")), core::InputError);
}

}  // namespace
}  // namespace triptych::judge
