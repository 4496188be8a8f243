#include "record/device_id.hpp"

#include <fmt/format.h>

namespace triptych::record {

std::string numbered_id(std::string_view id, int number) {
  return number == 1 ? std::string(id) : fmt::format("{}#{}", id, number);
}

std::string family_of(std::string_view device) {
  std::string_view driver = device.substr(device.find(':') + 1);
  driver = driver.substr(0, driver.find('#'));
  return std::string(driver == "lavapipe" || driver.starts_with("llvmpipe") ? "llvmpipe" : driver);
}

}  // namespace triptych::record
