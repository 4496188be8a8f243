#pragma once
// What a device can no longer draw goes from its baselines.

#include <map>
#include <span>
#include <string>

#include "judge/baselines/next_folder.hpp"
#include "record/record.hpp"

namespace triptych::judge {

// What a table of {configuration: {device: …}} or {configuration: {name: {device: …}}} has of one
// on one, and what is empty then.
void erase_from(core::Json& table, const std::string& configuration, const std::string& device);

// All that is stored of the records' configurations on their devices; of what is stored by driver
// or machine, that of `devices` (by id).
void drop_skipped(std::span<const record::Record> skipped,
                  const std::map<std::string, record::Device>& devices, NextFolder& next);

}  // namespace triptych::judge
