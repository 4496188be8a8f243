#pragma once
// The columns of exported tables: each one says what it is and takes its cell from a row's source.

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "record/record.hpp"
#include "report/csv.hpp"

namespace triptych::report {

// What a dictionary says of a column. `type`: "text", "number" or "integer"; a flag is an integer,
// 0 or 1. `unit`: empty for none.
struct ColumnText {
  std::string name, type, unit, description;
};
[[nodiscard]] core::Json to_json(const ColumnText& column);

template <typename Source>
struct Column : ColumnText {
  std::function<Cell(const Source&)> cell;
};

template <typename Source>
using Columns = std::vector<Column<Source>>;

struct RunSource {
  std::string store;
  record::Run run;
};
struct DeviceSource {
  std::string run;
  record::Device device;
};
struct ClockSource {
  std::string run, device;
  record::ClockTrust clock;
};
struct RecordSource {
  std::uint64_t number;  // that the other tables name it by
  const record::Record& record;
};

// The names that make columns of their own.
struct RecordNames {
  std::set<std::string> factors, cost, memory, energy;
};

[[nodiscard]] Columns<RunSource> run_columns();
[[nodiscard]] Columns<DeviceSource> device_columns();
[[nodiscard]] Columns<ClockSource> clock_columns();
[[nodiscard]] Columns<RecordSource> record_columns(const RecordNames& names);

// "instructions", or what else a part of a cost counts.
[[nodiscard]] std::string cost_unit(const std::string& part);

}  // namespace triptych::report
