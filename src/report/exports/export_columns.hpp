#pragma once
// The columns of exported tables. Each one describes itself and takes its cell from the source of a
// row.

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "record/record.hpp"
#include "report/csv.hpp"

namespace triptych::report {

// The description of a column in the dictionary. `type` is "text", "number" or "integer"; a flag is
// an integer, 0 or 1. `unit` is empty if there is none.
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
  std::uint64_t number;  // the number by which other tables refer to it
  const record::Record& record;
};

// The names of factors, costs and other values that get a column each.
struct RecordNames {
  std::set<std::string> factors, cost, memory, energy;
};

[[nodiscard]] Columns<RunSource> run_columns();
[[nodiscard]] Columns<DeviceSource> device_columns();
[[nodiscard]] Columns<ClockSource> clock_columns();
[[nodiscard]] Columns<RecordSource> record_columns(const RecordNames& names);

// The unit in which a part of a cost is counted, such as "instructions".
[[nodiscard]] std::string cost_unit(const std::string& part);

}  // namespace triptych::report
