// Measures the memory and time needed to merge many records. With TRIPTYCH_MERGE_RECORDS=10000000,
// the test is as large as the results of a cluster, and takes 15 minutes and 26 GB of disk space.

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <vector>

#include "record/merge/merge.hpp"
#include "samples.hpp"
#include "store_fixture.hpp"

namespace triptych::record {
namespace {

namespace fs = std::filesystem;

int number_from(const char* variable, int standard) {
  const char* text = std::getenv(variable);
  return text == nullptr ? standard : std::stoi(text);
}

// The records resemble those of a volume study: 14 factors, a frame timed by two clocks, six
// counters. They are in plan order, in which cameras vary fastest, rather than in alphabetical
// order. A merge copies seals (checksums of rows) without checking them, so the seals need not be
// valid here.
constexpr const char* fill_sql = R"sql(
CREATE TEMP TABLE n AS WITH RECURSIVE n (seq, i) AS (
  SELECT 1, :first UNION ALL SELECT seq + 1, i + :step FROM n WHERE seq < :count)
SELECT seq, i, format('orbit_y:%d/252', i % 252) AS camera,
  format('generate:mandelbulb:%d', i / 50000) AS data,
  format('%g', 0.25 * (1 + i / 252 % 200)) AS step FROM n;
INSERT INTO record SELECT seq, 'RUN', 'volume', 'volume/paper',
  format('camera=%s,data=%s,ert=0,shading=gradient,step=%s,technique=raycast,viewport=512', camera, data, step),
  format('camera=%s,data=%s,quadrature=midpoint,shading=gradient,step=%s,transfer_function=haze,viewport=512',
    camera, data, step),
  'raycast', 'null:scripted', 'measured', 'none', 'working', '{}', '', '', 0, '', '',
  '', '', 'device', 1, 1e6 + i, 1e6 + i, 1e6 + i, 1, 4, 9, 2e7, 1, 3e7, 2e6,
  30572544, '', format('%032x', i / 50000), 'a44fa78c0d6a9275b10a1ed111e68b21', '', '{"merge_patches":[]}', format('%032x', i) FROM n;
INSERT INTO factor SELECT seq, name, coalesce(value, CASE name
    WHEN 'camera' THEN camera WHEN 'data' THEN data ELSE step END)
  FROM n, (SELECT column1 AS name, column2 AS value FROM (VALUES ('adapt', '0'), ('camera', NULL), ('data', NULL),
    ('ert', '0'), ('gl', 'auto'), ('quadrature', 'midpoint'), ('sampler', 'hardware'), ('shading', 'gradient'),
    ('skip', 'bricks'), ('step', NULL), ('technique', 'raycast'), ('transfer_function', 'haze'),
    ('viewport', '512'), ('voxel', 'u8'))) ORDER BY seq, name;
INSERT INTO sample SELECT seq, column1, 0, 1e6 + i FROM n, (VALUES ('device'), ('wall')) ORDER BY seq, column1;
INSERT INTO counter SELECT seq, column1, 7 * i FROM n, (VALUES ('rays_hit'), ('samples'), ('samples_nonzero'),
  ('samples_saved')) ORDER BY seq, column1;
INSERT INTO statistic SELECT seq, 'compute_invocations', 262144 FROM n;
INSERT INTO precision SELECT seq, 'filter_weight_error', 0.001953125 FROM n;
DROP TABLE n;
)sql";

void replace_all(std::string& text, std::string_view from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
}

class MergeLoad : public StoreTest {
 protected:
  // Creates shard `index` of `count`. A shard is a store with a part of a plan's records.
  [[nodiscard]] fs::path shard(int index, int count, int records) const {
    fs::path file = folder_ / fmt::format("shard-{}.sqlite", index);
    const std::string run = fmt::format("run-{:03}", index);
    {
      Store store(file, Store::Mode::append);
      store.add_run(sample_run(run, "volume/paper"));
      store.add_device(run, sample_device(), {});
    }
    SQLite::Database database(file.string(), SQLite::OPEN_READWRITE);
    database.exec("PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF; BEGIN");
    std::string sql = fill_sql;
    replace_all(sql, "RUN", run);
    replace_all(sql, ":first", std::to_string(index));
    replace_all(sql, ":step", std::to_string(count));
    replace_all(sql, ":count", std::to_string(records / count));
    database.exec(sql);
    database.exec("COMMIT");
    return file;
  }
};

TEST_F(MergeLoad, TakesBoundedMemory) {
  const int records = number_from("TRIPTYCH_MERGE_RECORDS", 20000);
  const int count = number_from("TRIPTYCH_MERGE_STORES", 20);
  std::vector<fs::path> files;
  for (int i = 0; i < count; ++i) files.push_back(shard(i, count, records));
  const auto begin = std::chrono::steady_clock::now();
  // The merge runs in a child process, for which the system reports the peak memory.
  const pid_t child = fork();
  if (child == 0) {
    std::uint64_t merged = 0;
    for (const auto& [device, of_device] :
         merge_stores(files, folder_ / "out").plans.at(0).counts.records) {
      merged += of_device;
    }
    std::_Exit(merged == static_cast<std::uint64_t>(records / count * count) ? 0 : 1);
  }
  int status = -1;
  rusage usage{};
  ASSERT_EQ(wait4(child, &status, 0, &usage), child);
  EXPECT_EQ(status, 0);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const auto processor = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  fmt::print(
      "{} records of {} stores in {:.1f} s, {:.1f} s of a processor: {:.0f} a second; {} MB\n",
      records, count, seconds, processor(usage.ru_utime) + processor(usage.ru_stime),
      records / seconds, usage.ru_maxrss / 1024);
  EXPECT_LE(usage.ru_maxrss, 512 << 10) << "KiB";
}

}  // namespace
}  // namespace triptych::record
