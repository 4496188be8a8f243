#pragma once
// Removes the configurations that a device can no longer draw from its baselines.

#include <map>
#include <span>
#include <string>

#include "judge/baselines/next_folder.hpp"
#include "record/record.hpp"

namespace triptych::judge {

// Removes one device of one configuration from a table of the form {configuration: {device: …}} or
// {configuration: {name: {device: …}}}, and the objects that become empty.
void erase_from(core::Json& table, const std::string& configuration, const std::string& device);

// Removes everything that is stored about the records' configurations on their devices. `devices`,
// by id, identify the values that are stored by driver or by machine.
void drop_skipped(std::span<const record::Record> skipped,
                  const std::map<std::string, record::Device>& devices, NextFolder& next);

}  // namespace triptych::judge
