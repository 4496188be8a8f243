#pragma once
// The columns of exported tables. Each column has a description and a function that computes its
// cell in a row.

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "record/record.hpp"
#include "report/csv.hpp"

namespace triptych::report {

// The entry of a column in dictionary.json. `type` is "text", "number" or "integer"; flags are the
// integers 0 and 1. `unit` is empty if the column has no unit.
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
  std::uint64_t number;  // the number by which other tables refer to the record
  const record::Record& record;
};

// The names of the factors, costs, kinds of memory and energy meters. Each name gets its own
// column.
struct RecordNames {
  std::set<std::string> factors, cost, memory, energy;
};

[[nodiscard]] Columns<RunSource> run_columns();
[[nodiscard]] Columns<DeviceSource> device_columns();
[[nodiscard]] Columns<ClockSource> clock_columns();
[[nodiscard]] Columns<RecordSource> record_columns(const RecordNames& names);

// Returns the unit in which a part of the cost is counted, such as "instructions".
[[nodiscard]] std::string cost_unit(const std::string& part);

}  // namespace triptych::report
