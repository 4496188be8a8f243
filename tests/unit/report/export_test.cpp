// Tests the CSV export of stores.

#include <gmock/gmock.h>

#include <limits>
#include <sstream>

#include "core/error.hpp"
#include "core/json.hpp"
#include "report/csv.hpp"
#include "report/exports/export_tables.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::report {
namespace {

using core::Json;
using record::Record;
using record::Store;
using testing::HasSubstr;

TEST(Csv, QuotesFieldsIfNecessaryAndLeavesMissingOnesEmpty) {
  EXPECT_EQ(csv_field({}), "");
  EXPECT_EQ(csv_field(std::numeric_limits<double>::quiet_NaN()), "");
  EXPECT_EQ(csv_field(0.0), "0");
  EXPECT_EQ(csv_field(0.1), "0.1");
  EXPECT_EQ(csv_field(3955887.0), "3955887");
  EXPECT_EQ(csv_field(std::numeric_limits<std::uint64_t>::max()), "18446744073709551615");
  EXPECT_EQ(csv_field(std::string("generate:uniform:1000")), "generate:uniform:1000");
  EXPECT_EQ(csv_field(std::string("a=1,b=2")), "\"a=1,b=2\"");
  EXPECT_EQ(csv_field(std::string("say \"x\"\n")), "\"say \"\"x\"\"\n\"");
}

// OpenOffice, Excel and Google Sheets evaluate cells that begin with one of these characters.
TEST(Csv, NoFieldIsAFormula) {
  for (const char* text : {"=1+1", "+1+1", "-1+1", "@SUM(1)", "=cmd|' /C calc'!A0", "＝1", "-"}) {
    const std::string field = csv_field(std::string(text));
    EXPECT_EQ(field, std::string("'") + text);
  }
  EXPECT_EQ(csv_field(std::string("\t=1")), "\"'\t=1\"");
  EXPECT_EQ(csv_field(std::string("\n=1")), "\"'\n=1\"");
  EXPECT_EQ(csv_field(std::string("=A,\"B\"")), "\"'=A,\"\"B\"\"\"");
  EXPECT_EQ(csv_field(std::string("a;=1")), "\"a;=1\"");
  EXPECT_EQ(csv_field(std::string("'a")), "''a");
  for (const char* text : {"-0.5", "-1e-9", "a=b", "", "0"}) {
    EXPECT_EQ(csv_field(std::string(text)), text);
  }
}

// Returns the fields of a line, in which no field may contain a line break.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields{""};
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

class ExportTest : public testing::Test {
 protected:
  ExportTest() : store_(folder_.path() / "s.sqlite", Store::Mode::append) {
    store_.add_run(run_);
    store_.add_device("r", {.id = "gl:x", .driver_version = "1, or 2"},
                      {{.work = "draw", .offered = false, .verdict = "tells none"}});
  }
  void add(const std::string& configuration, const std::function<void(Record&)>& change) {
    Record record{.run = "r", .suite = "volume", .plan = run_.plan};
    record.configuration = configuration;
    record.technique = "raycast";
    record.device = "gl:x";
    record.outcome = record::Outcome::measured;
    change(record);
    store_.add_record(record);
  }
  ExportedRows write(const std::string& plan = "") {
    return export_tables({&store_}, {.plan = plan, .folder = folder_.path(), .made_by = "a test"});
  }
  // Returns the rows of a table, each as a map from column names to fields.
  std::vector<std::map<std::string, std::string>> rows(const std::string& table) {
    std::istringstream text(folder_.read(table + ".csv"));
    std::string line;
    std::getline(text, line);
    const std::vector<std::string> names = fields_of(line);
    std::vector<std::map<std::string, std::string>> rows;
    while (std::getline(text, line)) {
      const std::vector<std::string> fields = fields_of(line);
      EXPECT_EQ(fields.size(), names.size()) << line;
      auto& row = rows.emplace_back();
      for (std::size_t i = 0; i < names.size(); ++i) row[names[i]] = fields.at(i);
    }
    return rows;
  }

  test::TemporaryFolder folder_;
  record::Run run_{.id = "r", .plan = "volume/quick", .started_at = "2026-01-02T03:04:05Z"};
  Store store_;
};

TEST_F(ExportTest, ARowForEachRecordAndAColumnForEachFactor) {
  add("step=1,data=a", [](Record& each) {
    each.factors = {{"step", "1"}, {"data", "a"}};
    each.wall_ns = {4, 2, 1000};
    each.device_ns = {1, 3};
    each.device_clock_trusted = true;
    each.memory = {{"buffers", 7}};
    each.energy = {{"package-0", 9}};
  });
  add("radius_scale=2", [](Record& each) {
    each.factors = {{"radius_scale", "2"}};
    each.cost = {{"device_code", 5}, {"misses", 6}};
    each.prepare_cost = {{"driver", 9}};
    each.counters = {{"samples", 0}};
    each.counted_by = "valgrind";
  });
  EXPECT_EQ(write().at("records"), 2U);
  const auto records = rows("records");
  EXPECT_EQ(records.at(0).at("configuration"), "step=1,data=a");
  EXPECT_EQ(records.at(0).at("factor_step"), "1");
  EXPECT_EQ(records.at(0).at("factor_radius_scale"), "");
  EXPECT_EQ(records.at(0).at("median_ns"), "2");
  EXPECT_EQ(records.at(0).at("median_wall_ns"), "4");
  EXPECT_EQ(records.at(0).at("clock"), "device");
  EXPECT_EQ(records.at(0).at("memory_bytes_buffers"), "7");
  EXPECT_EQ(records.at(0).at("energy_uj_package-0"), "9");
  EXPECT_EQ(records.at(0).at("cost_device_code"), "");
  EXPECT_EQ(records.at(1).at("cost_device_code"), "5");
  EXPECT_EQ(rows("samples").size(), 5U);
  EXPECT_EQ(rows("samples").at(2).at("time_ns"), "1000");
  const auto cost = rows("cost");
  ASSERT_EQ(cost.size(), 3U);
  EXPECT_EQ(cost.at(1).at("unit"), "cache lines");
  EXPECT_EQ(cost.at(2).at("of"), "prepare");
  EXPECT_EQ(rows("counters").at(0).at("count"), "0");  // counted, and not missing
}

// A value that was not measured must be exported as an empty field, and never as zero.
TEST_F(ExportTest, MissingIsEmpty) {
  add("step=1", [](Record& each) {
    each.outcome = record::Outcome::skipped;
    each.reason = {.cause = record::Cause::not_supported, .detail = "no compute, nor 3D images"};
  });
  write();
  const auto record = rows("records").at(0);
  EXPECT_EQ(record.at("cause"), "not_supported");
  EXPECT_EQ(record.at("reason"), "no compute, nor 3D images");
  for (const auto& [column, field] : record) EXPECT_NE(field, "0") << column;
  EXPECT_EQ(record.at("median_wall_ns"), "");
  EXPECT_EQ(record.at("clock"), "");
  EXPECT_EQ(rows("clocks").at(0).at("ratio"), "");  // a clock that reports no times has no ratio
}

TEST_F(ExportTest, TheDictionaryDescribesEveryColumn) {
  add("step=1", [](Record& each) { each.factors = {{"step", "1"}}; });
  const ExportedRows written = write();
  const Json dictionary = Json::parse(folder_.read("dictionary.json"));
  EXPECT_EQ(dictionary.at("made_by"), "a test");
  for (const auto& [table, count] : written) {
    const Json& of = dictionary.at("tables").at(table);
    EXPECT_EQ(of.at("rows"), count);
    EXPECT_EQ(rows(table).size(), count);
    std::string header;
    for (const Json& column : of.at("columns")) {
      header += (header.empty() ? "" : ",") + column.at("name").get<std::string>();
      EXPECT_FALSE(column.at("description").get<std::string>().empty()) << column;
      const auto name = column.at("name").get<std::string>();
      if (name.ends_with("_ns")) {
        EXPECT_EQ(column.at("unit"), "ns") << name;
      }
      if (name.find("bytes") != std::string::npos) {
        EXPECT_EQ(column.at("unit"), "bytes") << name;
      }
    }
    const std::string text = folder_.read(table + ".csv");
    EXPECT_EQ(text.substr(0, text.find('\n')), header);
  }
}

TEST_F(ExportTest, OfOnePlan) {
  store_.add_run({.id = "other", .plan = "volume/speed", .started_at = "2026"});
  add("step=1", [](Record&) {});
  EXPECT_EQ(write("volume/speed").at("records"), 0U);
  EXPECT_EQ(rows("runs").at(0).at("run"), "other");
  EXPECT_EQ(write().at("runs"), 2U);
  EXPECT_THROW(write("volume/none"), core::NotSupported);
}

TEST_F(ExportTest, ARunInTwoStoresIsRejected) {
  Store copy(folder_.path() / "copy.sqlite", Store::Mode::append);
  copy.add_run(run_);
  try {
    static_cast<void>(export_tables({&store_, &copy}, {.folder = folder_.path()}));
    ADD_FAILURE();
  } catch (const core::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("run r is in "));
    EXPECT_THAT(error.what(), HasSubstr("copy.sqlite"));
  }
}

TEST_F(ExportTest, AFailedWriteIsReportedAndLeavesNoDictionary) {
  static_cast<void>(write());
  std::filesystem::remove(folder_.path() / "samples.csv");
  std::filesystem::create_directory(folder_.path() / "samples.csv");
  EXPECT_THROW(write(), core::IoError);
  EXPECT_EQ(folder_.read("dictionary.json"), "");
}

}  // namespace
}  // namespace triptych::report
