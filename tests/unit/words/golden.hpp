#pragma once
// Files with the texts that are expected. TRIPTYCH_WRITE_GOLDEN=1 writes them anew: review the
// difference like any other change.

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

}  // namespace triptych::report
