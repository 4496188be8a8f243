#pragma once
// Loads plans from files, for a made-up suite.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.hpp"
#include "fake_suite.hpp"
#include "measure/plan/plan.hpp"

namespace triptych::measure {

class PlanTest : public ::testing::Test {
 protected:
  ~PlanTest() override { std::filesystem::remove(file_); }

  Plan load(const std::string& yaml, const Overrides& overrides = {}, const Shard& shard = {}) {
    std::ofstream(file_) << yaml;
    return load_plan(file_.string(), overrides, find_, shard);
  }

  // Returns the error message for a plan, without the folder of the file: "FILE:LINE:COLUMN:
  // MESSAGE".
  std::string refusal(const std::string& yaml, const Overrides& overrides = {}) {
    try {
      static_cast<void>(load(yaml, overrides));
    } catch (const core::InputError& error) {
      std::string text = error.what();
      const std::string folder = file_.parent_path().string() + "/";
      if (text.starts_with(folder)) text.erase(0, folder.size());
      return text;
    }
    return "was accepted";
  }

  std::string at(int line, int column) const {
    return file_.filename().string() + ":" + std::to_string(line) + ":" + std::to_string(column) +
           ": ";
  }

  FakeSuite suite_;
  FindSuite find_ = [this](std::string_view name) -> Suite& {
    if (name != suite_.name()) {
      throw core::InputError("unknown suite '" + std::string(name) + "'; there are: fake");
    }
    return suite_;
  };
  std::filesystem::path file_ =
      std::filesystem::path(::testing::TempDir()) /
      (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".yaml");
};

}  // namespace triptych::measure
