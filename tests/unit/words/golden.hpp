#pragma once
// Compares output with golden files. Set TRIPTYCH_WRITE_GOLDEN=1 to regenerate the files, and
// review their changes like any other change.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/file.hpp"

namespace triptych::report {

inline void expect_golden(const std::string& name, const std::string& text) {
  const std::filesystem::path file = std::filesystem::path(TRIPTYCH_GOLDEN_FOLDER) / name;
  if (std::getenv("TRIPTYCH_WRITE_GOLDEN") != nullptr) core::write_file(text, file);
  ASSERT_TRUE(std::filesystem::exists(file)) << file;
  EXPECT_EQ(text, core::read_text(file)) << "TRIPTYCH_WRITE_GOLDEN=1 writes " << file;
}

// Calls `act` with every named value of an enum.
template <typename Enum, typename Act>
void for_each_value(const Act& act) {
  const auto has_name = [](int i) { return name_of(static_cast<Enum>(i)) != "unknown"; };
  for (int i = 0; has_name(i) || has_name(i + 1); ++i) act(static_cast<Enum>(i));
}

}  // namespace triptych::report
