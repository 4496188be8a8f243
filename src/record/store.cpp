#include "record/store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/image_io.hpp"
#include "record/store_file.hpp"
#include "record/store_records.hpp"
#include "record/store_runs.hpp"
#include "record/store_seal.hpp"
#include "record/store_values.hpp"

namespace triptych::record {
namespace {

// While an object of this class exists, each commit is flushed to the disk, so that this commit and
// all earlier commits survive a power failure.
class FlushedCommits {
 public:
  explicit FlushedCommits(SQLite::Database& database) : database_(database) {
    database_.exec("PRAGMA synchronous = FULL");
  }
  ~FlushedCommits() { static_cast<void>(database_.tryExec("PRAGMA synchronous = NORMAL")); }
  FlushedCommits(const FlushedCommits&) = delete;
  FlushedCommits& operator=(const FlushedCommits&) = delete;

 private:
  SQLite::Database& database_;
};

}  // namespace

struct Store::State {
  std::filesystem::path file;
  SQLite::Database database;

  // Runs `action` in one transaction. The transaction takes the write lock at its beginning,
  // because SQLite does not wait for the lock if a transaction begins by reading and writes later.
  template <typename Action>
  void write(Action&& action) {
    on_store(file, [&] {
      SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
      action();
      transaction.commit();
      require_file(file, database);
    });
  }

  void require_run(std::string_view run) const {
    SQLite::Statement row = prepared(database, "SELECT 1 FROM run WHERE id = ?", run);
    if (row.executeStep()) return;
    throw core::InputError({.file = file.string()},
                           fmt::format("run '{}' is not in the store; add it first", run));
  }
};

Store::Store(const std::filesystem::path& file, Mode mode, std::chrono::milliseconds busy_limit)
    : state_(std::make_unique<State>(State{file, open_store_file(file, mode, busy_limit)})) {}
Store::~Store() = default;
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;

const std::filesystem::path& Store::file() const {
  return state_->file;
}

// Checks the whole file, because SQLite works around most damage without reporting it. quick_check
// reads every page, which takes 0.2 s for a store of 50 MB, but it does not compare indexes with
// their tables.
void Store::require_whole() const {
  on_store(state_->file, [&] {
    SQLite::Statement row(state_->database, "PRAGMA quick_check(1)");
    std::string answer = row.executeStep() ? row.getColumn(0).getString() : "no answer";
    std::ranges::replace(answer, '\n', ' ');
    if (answer != "ok") throw_damaged(state_->file, answer);
  });
}

void Store::add_run(const Run& run) {
  state_->write([&] { insert_run(state_->database, run); });
}

Run Store::latest_run_or_add(const Run& run) {
  Run found = run;
  state_->write([&] {
    const std::optional<Run> latest = latest_run_in(state_->database, run.plan);
    if (latest) {
      found = *latest;
    } else {
      insert_run(state_->database, run);
    }
  });
  return found;
}

void Store::begin(const std::string& run, const RunStart& start,
                  std::span<const std::string> configurations) {
  on_store(state_->file, [&] {
    const FlushedCommits flushed(state_->database);
    state_->write([&] {
      state_->require_run(run);
      std::vector<Run> all = read_runs(state_->database);
      Run& known = *std::ranges::find(all, run, &Run::id);
      known.begun.push_back(start);
      known.begun = joined(std::move(known.begun));
      insert_planned(state_->database, run, configurations);
      const std::vector<std::string> planned = read_planned(state_->database, run);
      known.configurations = planned.size();
      known.planned_hash = hash_of_planned(planned);
      insert_run(state_->database, known);
    });
    // Copies the log into the main file. If the run is killed, even a copy of the store without its
    // log must contain the beginning of this run. Otherwise the latest run in the copy would be a
    // previous run, which may have passed.
    static_cast<void>(state_->database.tryExec("PRAGMA wal_checkpoint(PASSIVE)"));
  });
}

void Store::add_device(const std::string& run, const Device& d,
                       const std::vector<ClockTrust>& clocks) {
  state_->write([&] {
    state_->require_run(run);
    insert_device(state_->database, run, d, clocks);
  });
}

void Store::add_image(std::string_view hash, std::span<const std::byte> exr) {
  state_->write([&] {
    execute(state_->database, "INSERT INTO image VALUES (?, ?, ?) ON CONFLICT (hash) DO NOTHING",
            hash, exr, core::content_hash(exr));
  });
}

void Store::add_record(const Record& r) {
  state_->write([&] {
    const SQLite::Database& database = state_->database;
    state_->require_run(r.run);
    execute(database, "DELETE FROM record WHERE run = ? AND configuration = ? AND device = ?",
            r.run, r.configuration, r.device);
    execute(database, "DELETE FROM begun WHERE run = ? AND configuration = ? AND device = ?", r.run,
            r.configuration, r.device);
    insert_record(database, r);
  });
}

int Store::begin_record(const std::string& run, const std::string& configuration,
                        const std::string& device) {
  return on_store(state_->file, [&] {
    const FlushedCommits flushed(state_->database);
    int attempts = 0;
    state_->write([&] {
      state_->require_run(run);
      SQLite::Statement row =
          prepared(state_->database,
                   "INSERT INTO begun VALUES (?, ?, ?, 1) ON CONFLICT (run, configuration, device) "
                   "DO UPDATE SET times = times + 1 RETURNING times",
                   run, configuration, device);
      row.executeStep();
      attempts = row.getColumn(0).getInt();
    });
    return attempts;
  });
}

void Store::unbegin_record(const std::string& run, const std::string& configuration,
                           const std::string& device) {
  state_->write([&] {
    execute(state_->database,
            "UPDATE begun SET times = times - 1 WHERE run = ? AND configuration = ? AND device = ?",
            run, configuration, device);
  });
}

void Store::set_truth(const TruthImage& truth) {
  state_->write([&] {
    execute(state_->database, "INSERT OR REPLACE INTO truth VALUES (?, ?, ?, ?, ?, ?)", truth.scene,
            truth.version, truth.image, truth.bound, truth.own_seal, seal_of(truth));
  });
}

std::vector<Run> Store::runs() const {
  return on_store(state_->file, [&] { return read_runs(state_->database); });
}

std::optional<Run> Store::latest_run(std::string_view plan) const {
  return on_store(state_->file, [&] { return latest_run_in(state_->database, plan); });
}

std::vector<std::string> Store::planned(const Run& run) const {
  return on_store(state_->file, [&] {
    std::vector<std::string> planned = read_planned(state_->database, run.id);
    const bool none = planned.empty() && run.planned_hash.empty();
    if (!none) {
      require_seal(run.planned_hash, hash_of_planned(planned),
                   fmt::format("the list of configurations of run '{}'", run.id));
    }
    return planned;
  });
}

std::set<std::string> Store::configurations(std::string_view run, std::string_view device) const {
  return on_store(state_->file, [&] {
    std::set<std::string> found;
    SQLite::Statement rows =
        prepared(state_->database, "SELECT configuration FROM record WHERE run = ? AND device = ?",
                 run, device);
    while (rows.executeStep()) found.insert(rows.getColumn(0).getString());
    return found;
  });
}

std::vector<Store::DeviceEntry> Store::devices(std::string_view run) const {
  return on_store(state_->file, [&] { return read_devices(state_->database, run); });
}

std::vector<Record> Store::records(std::string_view run) const {
  return on_store(state_->file, [&] {
    // Within a transaction, all queries see the same state of the file, even if another process
    // writes to it.
    SQLite::Transaction snapshot(state_->database, SQLite::TransactionBehavior::DEFERRED);
    return read_records(state_->database, run);
  });
}

void Store::visit_records(std::string_view run,
                          const std::function<void(const Record&)>& visit) const {
  on_store(state_->file, [&] {
    SQLite::Transaction snapshot(state_->database, SQLite::TransactionBehavior::DEFERRED);
    record::visit_records(state_->database, run, visit);
  });
}

std::set<std::string> Store::names(std::string_view run, std::string_view table) const {
  return on_store(state_->file, [&] {
    std::set<std::string> names;
    SQLite::Statement rows =
        prepared(state_->database,
                 fmt::format("SELECT DISTINCT t.name FROM record r JOIN {} t ON t.record = r.seq "
                             "WHERE r.run = ?",
                             table),
                 run);
    while (rows.executeStep()) names.insert(rows.getColumn(0).getString());
    return names;
  });
}

bool Store::has_record(std::string_view run, std::string_view configuration,
                       std::string_view device) const {
  return on_store(state_->file, [&] {
    return prepared(state_->database,
                    "SELECT 1 FROM record WHERE run = ? AND configuration = ? AND device = ?", run,
                    configuration, device)
        .executeStep();
  });
}

std::vector<std::byte> Store::image(std::string_view hash) const {
  return on_store(state_->file, [&] {
    SQLite::Statement row =
        prepared(state_->database, "SELECT exr, seal FROM image WHERE hash = ?", hash);
    if (!row.executeStep()) {
      throw core::InputError({.file = state_->file.string()},
                             fmt::format("there is no image '{}' in the store", hash));
    }
    std::vector<std::byte> exr;
    std::string seal;
    Reader(row) >> exr >> seal;
    require_seal(seal, core::content_hash(exr), fmt::format("image '{}'", hash));
    return exr;
  });
}

core::Image Store::decoded_image(std::string_view hash) const {
  return core::decode_exr(image(hash), fmt::format("{}: image '{}'", state_->file.string(), hash));
}

std::optional<TruthImage> Store::truth(std::string_view scene, std::string_view version) const {
  return on_store(state_->file, [&]() -> std::optional<TruthImage> {
    SQLite::Statement row = prepared(state_->database,
                                     "SELECT scene, version, image, bound, own_seal, seal FROM "
                                     "truth WHERE scene = ? AND version = ?",
                                     scene, version);
    if (!row.executeStep()) return std::nullopt;
    TruthImage truth;
    std::string seal;
    Reader(row) >> truth.scene >> truth.version >> truth.image >> truth.bound >> truth.own_seal >>
        seal;
    require_seal(seal, seal_of(truth), fmt::format("the reference image of {}", scene));
    return truth;
  });
}

void Store::add_listing(std::string_view hash, std::string_view text) {
  state_->write([&] {
    execute(state_->database, "INSERT INTO listing VALUES (?, ?, ?) ON CONFLICT (hash) DO NOTHING",
            hash, text, core::content_hash(text));
  });
}

std::optional<std::string> Store::listing(std::string_view hash) const {
  return on_store(state_->file, [&]() -> std::optional<std::string> {
    SQLite::Statement row =
        prepared(state_->database, "SELECT text FROM listing WHERE hash = ?", hash);
    if (!row.executeStep()) return std::nullopt;
    std::string text;
    Reader(row) >> text;
    require_seal(hash, core::content_hash(text), fmt::format("disassembly '{}'", hash));
    return text;
  });
}

std::vector<Run> latest_runs(const Store& store) {
  std::map<std::string, Run> by_plan;
  for (Run& run : store.runs()) by_plan.insert_or_assign(run.plan, std::move(run));
  std::vector<Run> runs;
  for (auto& [plan, run] : by_plan) runs.push_back(std::move(run));
  return runs;
}

}  // namespace triptych::record
