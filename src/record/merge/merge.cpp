#include "record/merge/merge.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <set>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "record/merge/merged_runs.hpp"
#include "record/store_file.hpp"
#include "record/store_runs.hpp"

namespace triptych::record {
namespace {

namespace fs = std::filesystem;

// The maximum number of stores that are merged at once. It is limited because each open store needs
// three file descriptors and a share of the memory. If there are more stores, they are merged in
// groups of this size, and then the results of the groups are merged.
constexpr std::size_t most_open_stores = 64;
constexpr int source_cache_kib = 96 << 10;  // SQLite page cache, total for all sources
constexpr int out_cache_kib = 96 << 10;
constexpr std::chrono::seconds busy_limit{10};

// Intermediate stores, which the destructor removes.
class IntermediateStores {
 public:
  explicit IntermediateStores(const fs::path& out) : out_(out) {}
  ~IntermediateStores() {
    for (const fs::path& each : files_) remove(each);
  }
  IntermediateStores(const IntermediateStores&) = delete;
  IntermediateStores& operator=(const IntermediateStores&) = delete;

  fs::path add() {
    files_.push_back(out_);
    files_.back() += fmt::format(".{}-{}.part", ::getpid(), files_.size());
    remove(files_.back());
    return files_.back();
  }
  static void remove(const fs::path& store) {
    std::error_code ignored;
    for (const char* part : {"", "-wal", "-shm", "-journal"}) {
      fs::remove(store.string() + part, ignored);
    }
  }

 private:
  fs::path out_;
  std::vector<fs::path> files_;
};

// Runs `action`, which writes to an intermediate file. Error messages name `out`, the file that the
// user requested, because intermediate files are removed.
template <typename Action>
decltype(auto) on_new_store(const fs::path& out, Action&& action) {
  try {
    return std::forward<Action>(action)();
  } catch (const SQLite::Exception& error) {
    if (error.getErrorCode() == SQLITE_FULL) {
      throw core::IoError(fmt::format("{}: the disk is full; nothing was merged", out.string()));
    }
    throw_store_error(out, error);
  }
}

// A store to be merged, with the id of its run for each plan.
struct Input {
  fs::path file;
  std::vector<std::string> runs;
};

// Merges several inputs into one intermediate file.
class StoreWriter {
 public:
  StoreWriter(const std::vector<Input>& inputs, const fs::path& file, const fs::path& out)
      : out_file_(out), out_(on_new_store(out, [&] { return open_new_store_file(file); })) {
    on_new_store(out, [&] { out_.exec(fmt::format("PRAGMA cache_size = -{}", out_cache_kib)); });
    sources_.reserve(inputs.size());
    const int share = source_cache_kib / static_cast<int>(std::max<std::size_t>(1, inputs.size()));
    for (const Input& each : inputs) {
      Source& source = sources_.emplace_back(
          Source{each.file, open_store_file(each.file, Store::Mode::read, busy_limit)});
      // Within a transaction, all queries see the same state of the file, even if another process
      // writes to it.
      on_store(each.file, [&] {
        source.database.exec(fmt::format("PRAGMA cache_size = -{}", share));
        source.database.exec("BEGIN");
      });
    }
  }

  // Writes the runs. Returns, for each run, how many records were copied and how many were left
  // out.
  std::vector<RecordCounts> write(const std::vector<Input>& inputs, const std::vector<Run>& runs,
                                  DataHashes& data, const RecordCopy::OnProgress& on_progress) {
    return on_new_store(out_file_, [&] {
      out_.exec("BEGIN");
      std::vector<RecordCounts> counts;
      {
        RecordCopy copy(sources_, out_, data, on_progress);
        for (std::size_t i = 0; i < runs.size(); ++i) {
          std::vector<std::string> parts;
          parts.reserve(inputs.size());
          for (const Input& each : inputs) parts.push_back(each.runs[i]);
          counts.push_back(copy.copy(parts, runs[i].id));
          copy_begun(parts, runs[i].id);
        }
      }
      copy_named("image", {"hash"}, {"exr"});
      copy_named("listing", {"hash"}, {"text"});
      copy_named("truth", {"scene", "version"}, {"image", "bound", "own_seal"});
      out_.exec("COMMIT");
      return counts;
    });
  }

 private:
  // Copies the list of configurations that were begun but that have no record.
  void copy_begun(const std::vector<std::string>& parts, const std::string& run) {
    MergedRows rows(
        sources_,
        "SELECT configuration, device, times FROM begun WHERE run = ?1 ORDER BY configuration, "
        "device",
        2, [](const Query& a, const Query& b) { return a.integer(2) > b.integer(2); }, parts);
    Query insert(out_,
                 "INSERT INTO begun SELECT ?1, ?2, ?3, ?4 WHERE NOT EXISTS (SELECT 1 FROM record "
                 "WHERE run = ?1 AND configuration = ?2 AND device = ?3)");
    while (const MergedRows::Row* row = rows.next()) {
      insert.bind(1, std::string_view(run));
      for (int i = 0; i < 3; ++i) insert.bind(i + 2, rows.query(row->source), i);
      insert.execute();
    }
  }

  // Copies one row for each key of a table whose rows are large. Only the keys and seals (hashes)
  // are read from all stores; the content of a row is read only if the row is copied.
  void copy_named(const std::string& table, const std::vector<std::string>& key,
                  const std::vector<std::string>& content) {
    const int keys = static_cast<int>(key.size());
    const std::string names = fmt::format("{}", fmt::join(key, ", "));
    const auto before = [keys](const Query& a, const Query& b) {
      return a.text(keys) < b.text(keys);
    };
    MergedRows rows(sources_,
                    fmt::format("SELECT {}, seal, rowid FROM {} ORDER BY {}", names, table, names),
                    keys, before);
    const std::string columns = fmt::format("{}, {}, seal", names, fmt::join(content, ", "));
    const int count = keys + static_cast<int>(content.size()) + 1;
    const std::vector<std::string> places(static_cast<std::size_t>(count), "?");
    Query insert(out_, fmt::format("INSERT INTO {} ({}) VALUES ({})", table, columns,
                                   fmt::join(places, ", ")));
    while (const MergedRows::Row* row = rows.next()) {
      const Source& source = sources_[row->source];
      on_store(source.file, [&] {
        Query read(source.database,
                   fmt::format("SELECT {} FROM {} WHERE rowid = ?1", columns, table));
        read.bind(1, rows.query(row->source).integer(keys + 1));
        read.step();
        for (int i = 0; i < count; ++i) insert.bind(i + 1, read, i);
      });
      insert.execute();
    }
  }

  fs::path out_file_;
  SQLite::Database out_;
  std::vector<Source> sources_;
};

void require_no_store(const fs::path& out) {
  if (out.empty()) throw core::InputError("the name of the store is empty; expected a file name");
  std::error_code ignored;
  if (fs::exists(out, ignored)) {
    throw core::InputError({.file = out.string()},
                           "already exists; choose another name, or remove this file if the "
                           "stores to be merged contain all of its records");
  }
  // SQLite would treat a left-over log as the log of the new store.
  if (fs::exists(out.string() + "-wal", ignored) && !fs::is_empty(out.string() + "-wal", ignored)) {
    throw core::InputError({.file = out.string() + "-wal"},
                           "is the log of a store that no longer exists; remove it, or choose "
                           "another name for the new store");
  }
}

void add(const std::vector<RecordCounts>& part, std::vector<RecordCounts>& sum) {
  for (std::size_t i = 0; i < part.size(); ++i) {
    sum[i].configurations = part[i].configurations;
    sum[i].records = part[i].records;
    sum[i].repeated += part[i].repeated;
    sum[i].injected += part[i].injected;
    sum[i].not_chosen += part[i].not_chosen;
    sum[i].remeasured += part[i].remeasured;
  }
}

// Writes the records and images of all inputs to an intermediate file. Merges in several steps if
// there are more than `most_open_stores` inputs.
struct StepwiseMerge {
  const std::vector<Run>& runs;
  const RecordCopy::OnProgress& on_progress;
  const fs::path& out;
  IntermediateStores& intermediate;
  DataHashes data;
  // The number of records that were left out, summed over all steps, and the number of records that
  // were copied in the last step, because each step copies the remaining records again.
  std::vector<RecordCounts> counts;

  fs::path merge(std::vector<Input> inputs) {
    while (inputs.size() > most_open_stores) {
      std::vector<Input> merged;
      for (std::size_t begin = 0; begin < inputs.size(); begin += most_open_stores) {
        const std::size_t end = std::min(begin + most_open_stores, inputs.size());
        Input& group = merged.emplace_back();
        group.file = step({inputs.begin() + static_cast<std::ptrdiff_t>(begin),
                           inputs.begin() + static_cast<std::ptrdiff_t>(end)});
        for (const Run& each : runs) group.runs.push_back(each.id);
      }
      inputs = std::move(merged);
    }
    return step(inputs);
  }

  fs::path step(const std::vector<Input>& inputs) {
    fs::path file = intermediate.add();
    add(StoreWriter(inputs, file, out).write(inputs, runs, data, on_progress), counts);
    return file;
  }
};

// Adds the runs. This happens after the records have been copied, because the number of
// configurations is known only from the records. While the file is written, it has no log, because
// the output of a failed merge is simply removed. At the end, the file is switched to the journal
// mode that is needed for appending to it, and is flushed to the disk, so that it survives a power
// failure.
void add_runs(const fs::path& file, const fs::path& out, const std::vector<MergedRun>& runs) {
  on_new_store(out, [&] {
    SQLite::Database store = open_new_store_file(file);
    store.exec("BEGIN");
    for (const MergedRun& each : runs) {
      insert_run(store, each.run);
      insert_planned(store, each.run.id, each.planned);
      for (const auto& [device, clocks] : each.devices) {
        insert_device(store, each.run.id, device, clocks);
      }
    }
    store.exec("COMMIT");
    store.exec("PRAGMA synchronous = FULL");
    store.exec("PRAGMA journal_mode = WAL");
  });
}

}  // namespace

namespace {

// Returns the ids of all devices that the run was supposed to measure or that are stored for it.
std::set<std::string> devices_in(const Store& store, const Run& run) {
  const std::vector<std::string> begun = devices_of(run.begun);
  std::set<std::string> devices(begun.begin(), begun.end());
  for (const Store::DeviceEntry& each : store.devices(run.id)) devices.insert(each.device.id);
  return devices;
}

void add_gaps(const Store& store, const Run& run, std::vector<Gap>& gaps) {
  const std::set<std::string> devices = devices_in(store, run);
  const std::vector<std::string> planned = store.planned(run);
  if (devices.empty() && run.configurations > 0) {
    gaps.push_back({run.plan, "", 0, run.configurations, planned});
  }
  for (const std::string& device : devices) {
    const std::set<std::string> stored = store.configurations(run.id, device);
    Gap gap{run.plan, device, stored.size(), run.configurations};
    std::ranges::set_difference(planned, stored, std::back_inserter(gap.missing));
    if (!gap.missing.empty() || stored.size() < run.configurations) gaps.push_back(std::move(gap));
  }
}

}  // namespace

std::vector<Gap> gaps_of(const Store& store) {
  std::vector<Gap> gaps;
  const std::vector<Run> runs = latest_runs(store);
  for (const Run& run : runs) add_gaps(store, run, gaps);
  const auto is_empty = [](const Run& run) {
    return run.configurations == 0 && !run.begun.empty();
  };
  // A shard (one of n parts) of several plans may contain no configurations of the small plans, but
  // it must contain configurations of at least one plan.
  if (!runs.empty() && std::ranges::all_of(runs, is_empty)) {
    for (const Run& run : runs) gaps.push_back({run.plan, "", 0, 0});
  }
  return gaps;
}

MergeResult merge_stores(const std::vector<fs::path>& stores, const fs::path& out,
                         const RecordCopy::OnProgress& on_progress) {
  require_no_store(out);
  MergedRuns merged = merged_runs(stores);
  std::vector<Run> runs;
  std::vector<Input> inputs;
  inputs.reserve(stores.size());
  for (const fs::path& each : stores) inputs.push_back({each, {}});
  for (MergedRun& each : merged.runs) {
    for (std::size_t i = 0; i < stores.size(); ++i) inputs[i].runs.push_back(each.parts[i]);
    runs.push_back(each.run);
  }
  IntermediateStores intermediate(out);
  StepwiseMerge steps{runs,         on_progress, out,
                      intermediate, {},          std::vector<RecordCounts>(runs.size())};
  const fs::path file = steps.merge(std::move(inputs));
  MergeResult result{.plans = {}, .older_runs = merged.older};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Run& run = merged.runs[i].run;
    const std::vector<std::string>& planned = merged.runs[i].planned;
    run.configurations = planned.empty()
                             ? std::max(run.configurations, steps.counts[i].configurations)
                             : planned.size();
    if (!planned.empty()) run.planned_hash = hash_of_planned(planned);
    result.plans.push_back({run, std::move(steps.counts[i])});
  }
  add_runs(file, out, merged.runs);
  require_no_store(out);
  fs::rename(file, out);
  return result;
}

}  // namespace triptych::record
