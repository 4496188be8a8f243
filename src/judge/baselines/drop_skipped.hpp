#pragma once
// Removes configurations from the baselines of a device that can no longer draw them.

#include <map>
#include <span>
#include <string>

#include "judge/baselines/next_folder.hpp"
#include "record/record.hpp"

namespace triptych::judge {

// Removes the values of one configuration on one device from a table of the form {configuration:
// {device: …}} or {configuration: {name: {device: …}}}. Also removes objects that become empty.
void erase_from(core::Json& table, const std::string& configuration, const std::string& device);

// Removes all stored values of the skipped records from the files in `next`. `devices` contains the
// devices by id, because some files are named after a driver or a device key.
void drop_skipped(std::span<const record::Record> skipped,
                  const std::map<std::string, record::Device>& devices, NextFolder& next);

}  // namespace triptych::judge
