// Tests stores in which a value was changed in a way that SQLite does not detect. Such values must
// not affect a verdict.

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <span>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "record/store.hpp"
#include "samples.hpp"
#include "store_fixture.hpp"

namespace triptych::record {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;
using Mode = Store::Mode;

constexpr std::string_view image_content = "an image";
const std::string listing = core::content_hash("mov");

class StoreDamage : public StoreTest {
 protected:
  StoreDamage() {
    const auto bytes = std::as_bytes(std::span(image_content));
    Store store(file_, Mode::append);
    store.add_run(sample_run());
    store.add_device("run-1", sample_device(), {sample_clock()});
    Record record = sample_record();
    record.code["main"] = {.statistics = {{"instructions", 4}}, .assembly = listing};
    store.add_record(record);
    store.add_listing(listing, "mov");
    store.begin("run-1", {.devices = {"gl:x"}}, std::vector<std::string>{"step=1", "step=2"});
    store.add_image("0123", bytes);
    store.set_truth({"scene", "1", {bytes.begin(), bytes.end()}, {bytes.begin(), bytes.end()}});
  }

  void change(const std::string& sql) const {
    SQLite::Database database(file_.string(), SQLite::OPEN_READWRITE);
    ASSERT_GT(database.exec(sql), 0) << sql << " did not change anything";
  }

  // Reads everything that `gate`, `accept` and `report` read from a store.
  void read_all() const {
    const Store store(file_, Mode::read);
    store.require_whole();
    static_cast<void>(store.planned(store.latest_run("fake/quick").value()));
    static_cast<void>(store.devices("run-1"));
    static_cast<void>(store.records("run-1"));
    static_cast<void>(store.listing(listing));
    static_cast<void>(store.image("0123"));
    static_cast<void>(store.truth("scene", "1"));
  }
};

TEST_F(StoreDamage, AnIntactStoreIsAccepted) {
  EXPECT_NO_THROW(read_all());
}

TEST_F(StoreDamage, AVisitDetectsAChangedValue) {
  change("UPDATE counter SET value = value + 1 WHERE name = 'rays_hit'");
  const Store store(file_, Mode::read);
  EXPECT_THAT([&] { store.visit_records("run-1", [](const Record&) { FAIL(); }); },
              ThrowsMessage<core::InputError>(HasSubstr("was changed after it was written")));
}

TEST_F(StoreDamage, AChangedValueIsDetectedInEveryTable) {
  const std::vector<std::string> changes = {
      "UPDATE run SET plan_hash = 'x'",
      "UPDATE run SET configurations = 7",
      "UPDATE run SET started_at = '2099-01-01'",
      "UPDATE run SET checks = 'image'",
      "UPDATE planned SET configuration = 'x' WHERE configuration = 'step=1'",
      "UPDATE device SET driver_version = 'x'",
      "UPDATE device SET limits = '{}'",
      "UPDATE clock SET trusted = 0",
      "UPDATE statistics_calibration SET worth = 'unsteady' WHERE worth = 'inflated'",
      "UPDATE device_fault SET kind = 'memory_grows'",
      "UPDATE record SET cause = 'timeout'",
      "UPDATE record SET numbers = '{}'",
      "UPDATE record SET detail = 'x'",
      "UPDATE record SET outcome = 'skipped'",
      "UPDATE record SET injected = ''",
      "UPDATE sample SET ns = -ns",
      "DELETE FROM sample WHERE frame = 3",
      "DELETE FROM factor",
      "UPDATE counter SET value = 1 WHERE name = 'rays_hit'",
      "DELETE FROM statistic",
      "UPDATE cost SET value = value + 1",
      "UPDATE memory SET name = 'x'",
      "UPDATE energy SET value = value + 1",
      "UPDATE precision SET value = NULL",
      "UPDATE prepare_cost SET value = value + 1",
      "UPDATE executable SET assembly = 'x'",
      "UPDATE code SET value = value + 1",
      "UPDATE listing SET text = 'x'",
      "UPDATE same_as SET configuration = 'x'",
      "UPDATE image SET exr = x'00'",
      "UPDATE truth SET bound = x'00'"};
  for (const std::string& sql : changes) {
    std::filesystem::copy_file(file_, folder_ / "kept",
                               std::filesystem::copy_options::overwrite_existing);
    change(sql);
    EXPECT_THAT([&] { read_all(); },
                ThrowsMessage<core::InputError>(AllOf(
                    StartsWith(file_.string()), HasSubstr("was changed after it was written"))))
        << sql;
    std::filesystem::copy_file(folder_ / "kept", file_,
                               std::filesystem::copy_options::overwrite_existing);
  }
  // Only the table `begun` has no seal. It counts attempts, which do not affect a verdict.
  const SQLite::Database database(file_.string(), SQLite::OPEN_READONLY);
  SQLite::Statement tables(
      database, "SELECT name FROM sqlite_schema WHERE type = 'table' AND name <> 'begun'");
  while (tables.executeStep()) {
    const std::string table = " " + tables.getColumn(0).getString();
    EXPECT_TRUE(std::ranges::any_of(changes, [&](const std::string& sql) {
      return sql.find(table + " ") != std::string::npos || sql.ends_with(table);
    })) << table;
  }
}

TEST_F(StoreDamage, AnInvalidWordIsReportedWithTheFile) {
  change("UPDATE record SET outcome = 'passed'");
  EXPECT_THAT([&] { read_all(); },
              ThrowsMessage<core::InputError>(
                  AllOf(StartsWith(file_.string()), HasSubstr("unknown outcome 'passed'"))));
}

}  // namespace
}  // namespace triptych::record
