#include "report/exports/export_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/json_text.hpp"
#include "report/csv.hpp"
#include "report/exports/export_columns.hpp"

namespace triptych::report {
namespace {

using core::Json;
using record::Record;
using record::Run;
using record::Store;

// A table that is being written, and its description in the dictionary.
template <typename Source>
class Table {
 public:
  Table(const std::filesystem::path& folder, std::string name, std::string description,
        Columns<Source> columns)
      : name_(std::move(name)),
        description_(std::move(description)),
        columns_(std::move(columns)),
        row_(columns_.size()),
        file_(folder / (name_ + ".csv"), names()) {}

  void add(const Source& source) {
    for (std::size_t i = 0; i < columns_.size(); ++i) row_[i] = columns_[i].cell(source);
    file_.add(row_);
  }
  // Closes the file and adds it to the dictionary.
  void end(Json& dictionary, ExportedRows& rows) {
    file_.close();
    Json columns = Json::array();
    for (const auto& each : columns_) columns.push_back(to_json(each));
    dictionary["tables"][name_] = {
        {"description", description_}, {"rows", file_.rows()}, {"columns", std::move(columns)}};
    rows[name_] = file_.rows();
  }

 private:
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& each : columns_) names.push_back(each.name);
    return names;
  }

  std::string name_, description_;
  Columns<Source> columns_;
  std::vector<Cell> row_;
  CsvFile file_;
};

struct SampleSource {
  std::uint64_t record;
  std::string_view clock;
  std::uint64_t frame;
  double ns;
};
struct ValueSource {
  std::uint64_t record;
  std::string_view of;  // for a cost: "frame" or "prepare"
  const std::string& name;
  std::uint64_t value;
};

constexpr const char* record_number_text = "number of the record; see the table records";

Columns<SampleSource> sample_columns() {
  return {
      {{"record", "integer", "", record_number_text},
       [](const SampleSource& s) { return s.record; }},
      {{"clock", "text", "", "the clock: wall or device"},
       [](const SampleSource& s) { return std::string(s.clock); }},
      {{"frame", "integer", "", "zero-based index of the frame"},
       [](const SampleSource& s) { return s.frame; }},
      {{"time_ns", "number", "ns", "time of the frame"},
       [](const SampleSource& s) { return s.ns; }},
  };
}

Columns<ValueSource> value_columns(const std::string& description) {
  return {
      {{"record", "integer", "", record_number_text},
       [](const ValueSource& s) { return s.record; }},
      {{"name", "text", "", "name of the counter or statistic"},
       [](const ValueSource& s) { return s.name; }},
      {{"count", "integer", "events", description}, [](const ValueSource& s) { return s.value; }},
  };
}

Columns<ValueSource> cost_columns() {
  return {
      {{"record", "integer", "", record_number_text},
       [](const ValueSource& s) { return s.record; }},
      {{"of", "text", "", "what was counted: frame, or prepare (data, pipelines and upload)"},
       [](const ValueSource& s) { return std::string(s.of); }},
      {{"part", "text", "",
        "kind of event: instructions of one group (device_code, driver, libc or program), "
        "allocations, or misses"},
       [](const ValueSource& s) { return s.name; }},
      {{"unit", "text", "", "unit of the count"},
       [](const ValueSource& s) { return cost_unit(s.name); }},
      {{"count", "integer", "see the column unit", "the count"},
       [](const ValueSource& s) { return s.value; }},
  };
}

struct CodeSource {
  std::uint64_t record;
  const std::string& executable;
  const std::string& name;
  double value;
};

Columns<CodeSource> code_columns() {
  return {
      {{"record", "integer", "", record_number_text}, [](const CodeSource& s) { return s.record; }},
      {{"executable", "text", "", "shader stage or kernel"},
       [](const CodeSource& s) { return s.executable; }},
      {{"name", "text", "", "name of the statistic, as reported by the driver"},
       [](const CodeSource& s) { return s.name; }},
      {{"value", "number", "", "value of the statistic, as reported by the compiler"},
       [](const CodeSource& s) { return s.value; }},
  };
}

struct ErrorSource {
  std::uint64_t record;
  const ImageError& error;
};

Columns<ErrorSource> error_columns() {
  return {
      {{"record", "integer", "", record_number_text},
       [](const ErrorSource& s) { return s.record; }},
      {{"against", "text", "",
        "reference: the double-precision image with the same sample positions; limit: the image to "
        "which images converge as the step size approaches 0"},
       [](const ErrorSource& s) { return s.error.against; }},
      {{"metric", "text", "",
        "rms: root mean square over all pixels and channels; covered: root mean square over the "
        "pixels that are not empty in the reference or limit image; p99.9: 99.9th percentile of "
        "the pixel errors; max: largest pixel error"},
       [](const ErrorSource& s) { return s.error.metric; }},
      {{"error", "number", "full scale", "difference of linear colour values; white is 1"},
       [](const ErrorSource& s) { return s.error.error; }},
  };
}

struct EnergySource {
  std::uint64_t record;
  const std::string& meter;
  std::uint64_t microjoules;
};

Columns<EnergySource> energy_columns() {
  return {
      {{"record", "integer", "", record_number_text},
       [](const EnergySource& s) { return s.record; }},
      {{"meter", "text", "", "name of the meter"}, [](const EnergySource& s) { return s.meter; }},
      {{"energy_uj", "integer", "microjoules", "energy of one frame"},
       [](const EnergySource& s) { return s.microjoules; }},
  };
}

class Tables {
 public:
  Tables(const std::filesystem::path& folder, const RecordNames& names,
         const ExportRequest& request)
      : runs_(folder, "runs", "one `triptych run` per row", run_columns()),
        devices_(folder, "devices", "one device in one run per row", device_columns()),
        clocks_(
            folder, "clocks",
            "one row for each device and kind of work, with the calibration of the device clock",
            clock_columns()),
        records_(folder, "records", "one configuration on one device in one run per row",
                 record_columns(names)),
        samples_(folder, "samples", "one timed frame on one clock per row", sample_columns()),
        counters_(
            folder, "counters", "one of Triptych's counters per row",
            value_columns("number of events in one frame, counted by Triptych's device code")),
        statistics_(folder, "statistics", "one pipeline statistic per row",
                    value_columns("number of events in one frame, counted by the driver")),
        cost_(folder, "cost", "one part of a record's cost per row", cost_columns()),
        code_(folder, "code", "one compiler statistic of one shader stage or kernel per row",
              code_columns()),
        energy_(folder, "energy", "one energy meter for one record per row", energy_columns()),
        errors_of_(request.errors) {
    if (errors_of_) {
      errors_.emplace(folder, "errors", "one error metric of one record's image per row",
                      error_columns());
    }
  }

  void add(const Store& store, const Run& run) {
    runs_.add({store.file().string(), run});
    for (const auto& [device, clocks] : store.devices(run.id)) {
      devices_.add({run.id, device});
      for (const auto& clock : clocks) clocks_.add({run.id, device.id, clock});
    }
    store.visit_records(run.id, [&](const Record& record) { add(record); });
  }

  void end(Json& dictionary, ExportedRows& rows) {
    runs_.end(dictionary, rows);
    devices_.end(dictionary, rows);
    clocks_.end(dictionary, rows);
    records_.end(dictionary, rows);
    samples_.end(dictionary, rows);
    counters_.end(dictionary, rows);
    statistics_.end(dictionary, rows);
    cost_.end(dictionary, rows);
    code_.end(dictionary, rows);
    energy_.end(dictionary, rows);
    if (errors_) errors_->end(dictionary, rows);
  }

 private:
  void add(const Record& record) {
    const std::uint64_t number = ++last_;
    records_.add({number, record});
    for (const std::string_view clock : {"wall", "device"}) {
      const std::vector<double>& times = record.time_ns_by(clock);
      for (std::size_t i = 0; i < times.size(); ++i) samples_.add({number, clock, i, times[i]});
    }
    const auto add_all = [&](Table<ValueSource>& table, const record::Counts& counts,
                             std::string_view of) {
      for (const auto& [name, value] : counts) table.add({number, of, name, value});
    };
    add_all(counters_, record.counters, "frame");
    add_all(statistics_, record.statistics, "frame");
    add_all(cost_, record.cost, "frame");
    add_all(cost_, record.prepare_cost, "prepare");
    for (const auto& [executable, what] : record.code) {
      for (const auto& [name, value] : what.statistics) {
        code_.add({number, executable, name, value});
      }
    }
    for (const auto& [meter, microjoules] : record.energy) {
      energy_.add({number, meter, microjoules});
    }
    if (!errors_) return;
    for (const ImageError& each : errors_of_(record)) errors_->add({number, each});
  }

  std::uint64_t last_ = 0;
  Table<RunSource> runs_;
  Table<DeviceSource> devices_;
  Table<ClockSource> clocks_;
  Table<RecordSource> records_;
  Table<SampleSource> samples_;
  Table<ValueSource> counters_, statistics_, cost_;
  Table<CodeSource> code_;
  Table<EnergySource> energy_;
  std::function<std::vector<ImageError>(const Record&)> errors_of_;
  std::optional<Table<ErrorSource>> errors_;
};

struct RunInStore {
  const Store* store;
  Run run;
};

std::vector<RunInStore> runs_of(const std::vector<const Store*>& stores, const std::string& plan) {
  std::vector<RunInStore> runs;
  std::map<std::string, std::string> stores_of;
  std::set<std::string> plans;
  for (const Store* store : stores) {
    for (Run& run : store->runs()) {
      plans.insert(run.plan);
      if (!plan.empty() && run.plan != plan) continue;
      const auto [at, is_new] = stores_of.emplace(run.id, store->file().string());
      if (!is_new) {
        throw core::InputError(fmt::format(
            "run {} is in both {} and {}, so its records would be counted twice; export "
            "only one of these stores",
            run.id, at->second, store->file().string()));
      }
      runs.push_back({store, std::move(run)});
    }
  }
  if (runs.empty()) {
    throw core::NotSupported(
        fmt::format("there is no run{} to export; the stores contain these plans: {}",
                    plan.empty() ? std::string() : " of plan " + plan,
                    plans.empty() ? "none" : fmt::to_string(fmt::join(plans, ", "))));
  }
  return runs;
}

RecordNames names_of(const std::vector<RunInStore>& runs) {
  RecordNames names;
  for (const auto& [store, run] : runs) {
    names.factors.merge(store->names(run.id, "factor"));
    names.cost.merge(store->names(run.id, "cost"));
    names.memory.merge(store->names(run.id, "memory"));
    names.energy.merge(store->names(run.id, "energy"));
  }
  return names;
}

}  // namespace

ExportedRows export_tables(const std::vector<const Store*>& stores, const ExportRequest& request) {
  const std::vector<RunInStore> runs = runs_of(stores, request.plan);
  const std::filesystem::path dictionary_file = request.folder / "dictionary.json";
  std::filesystem::remove(dictionary_file);
  Tables tables(request.folder, names_of(runs), request);
  for (const auto& [store, run] : runs) {
    if (request.on_run) request.on_run(run);
    tables.add(*store, run);
  }
  ExportedRows rows;
  Json dictionary{
      {"schema", 1},
      {"made_by", request.made_by},
      {"missing", "an empty field means that the value is unknown; it never means zero"}};
  tables.end(dictionary, rows);
  core::write_file(core::json_text(dictionary, 1) + '\n', dictionary_file);
  return rows;
}

}  // namespace triptych::report
