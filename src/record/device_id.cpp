#include "record/device_id.hpp"

#include <fmt/format.h>

namespace triptych::record {

std::string numbered_id(std::string_view id, int number) {
  return number == 1 ? std::string(id) : fmt::format("{}#{}", id, number);
}

}  // namespace triptych::record
