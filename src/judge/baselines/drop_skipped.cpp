#include "judge/baselines/drop_skipped.hpp"

#include "judge/baselines/layout.hpp"

namespace triptych::judge {
namespace {

using core::Json;

// Removes a device from an object of the form {device: …} or {name: {device: …}}, and then removes
// objects that became empty.
void erase_device(Json& values, const std::string& device) {
  values.erase(device);
  for (auto item = values.begin(); item != values.end();) {
    if (item->is_object()) item->erase(device);
    item = item->is_object() && item->empty() ? values.erase(item) : std::next(item);
  }
}

// Removes the values of the skipped records from a file that contains the values of all devices.
void drop_from_table(std::span<const record::Record> skipped, const char* name, NextFolder& next) {
  if (!next.files.contains(name)) return;
  Update file(next, name);
  Json& table = file.value();
  for (const record::Record& record : skipped) {
    erase_from(table, record.configuration, record.device);
  }
  file.write(2);
}

// Removes the values of the skipped records from a file that contains the values of one device.
void drop_from_file(std::span<const record::Record> skipped, const std::string& device,
                    const std::string& name, int depth, NextFolder& next) {
  if (!next.files.contains(name)) return;
  Update file(next, name);
  const auto table = file.value().find("configurations");
  if (table == file.value().end() || !table->is_object()) return;
  for (const record::Record& record : skipped) {
    if (record.device == device) table->erase(record.configuration);
  }
  file.write(depth);
}

}  // namespace

void erase_from(Json& table, const std::string& configuration, const std::string& device) {
  const auto found = table.find(configuration);
  if (found == table.end()) return;
  erase_device(*found, device);
  if (found->empty()) table.erase(found);
}

void drop_skipped(std::span<const record::Record> skipped,
                  const std::map<std::string, record::Device>& devices, NextFolder& next) {
  if (skipped.empty()) return;
  for (const char* name : {Layout::counters, Layout::memory, Layout::errors, Layout::scores}) {
    drop_from_table(skipped, name, next);
  }
  for (const auto& [id, device] : devices) {
    drop_from_file(skipped, id, Layout::cost(device), 3, next);
    drop_from_file(skipped, id, Layout::code(device), 4, next);
    drop_from_file(skipped, id, Layout::statistics(device), 3, next);
    drop_from_file(skipped, id, Layout::timings(device), 2, next);
  }
}

}  // namespace triptych::judge
