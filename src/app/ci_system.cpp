#include "app/ci_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <utility>

#include "app/terminal.hpp"

namespace triptych::app {
namespace {

namespace fs = std::filesystem;

std::string environment_text(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// Writes control sequences for the CI system to stderr, without escaping them as print_err() would.
void write_control(const std::string& text) {
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
}

}  // namespace

void add_ci_option(CLI::App& command, std::string& name) {
  command
      .add_option(
          "--ci", name,
          "Also write output for a CI system: github (annotations, a job summary and collapsible "
          "log sections), gitlab (codequality.json in the --out folder, and collapsible log "
          "sections), none, or auto (detect the CI system from its environment variables)")
      ->capture_default_str();
}

CiSystem ci_system(const std::string& name) {
  if (name == "github") return CiSystem::github;
  if (name == "gitlab") return CiSystem::gitlab;
  if (name == "none") return CiSystem::none;
  if (name != default_ci) {
    throw core::InputError(fmt::format("--ci {}: expected auto, github, gitlab or none", name));
  }
  if (environment_text("GITHUB_ACTIONS") == "true") return CiSystem::github;
  if (environment_text("GITLAB_CI") == "true") return CiSystem::gitlab;
  return CiSystem::none;
}

fs::path ci_repository(CiSystem system) {
  std::string folder;
  if (system == CiSystem::github) folder = environment_text("GITHUB_WORKSPACE");
  if (system == CiSystem::gitlab) folder = environment_text("CI_PROJECT_DIR");
  return folder.empty() ? fs::current_path() : fs::path(folder);
}

std::string ci_job_file(CiSystem system) {
  if (system == CiSystem::gitlab) {
    const std::string file = environment_text("CI_CONFIG_PATH");
    return file.empty() ? ".gitlab-ci.yml" : file;
  }
  if (system != CiSystem::github) return {};
  // The variable has the form "owner/name/.github/workflows/file.yml@refs/heads/main".
  const std::string workflow = environment_text("GITHUB_WORKFLOW_REF");
  const std::string repository = environment_text("GITHUB_REPOSITORY") + "/";
  if (repository.size() < 2 || !workflow.starts_with(repository)) return {};
  return workflow.substr(repository.size(), workflow.rfind('@') - repository.size());
}

void add_to_job_summary(CiSystem system, const std::string& markdown) {
  const std::string file = environment_text("GITHUB_STEP_SUMMARY");
  if (system != CiSystem::github || file.empty()) return;
  std::ofstream out(file, std::ios::binary | std::ios::app);
  out << markdown << '\n' << std::flush;
  if (!out) print_err("triptych: cannot write the job summary to {}\n", file);
}

LogSection::LogSection(CiSystem system, std::string title) : system_(system) {
  if (system_ == CiSystem::github) write_control(fmt::format("::group::{}\n", title));
  if (system_ != CiSystem::gitlab) return;
  name_ = title;
  std::ranges::replace_if(
      name_, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  write_control(
      fmt::format("\033[0Ksection_start:{}:{}\r\033[0K{}\n", std::time(nullptr), name_, title));
}

LogSection::~LogSection() {
  if (system_ == CiSystem::github) write_control("::endgroup::\n");
  if (system_ == CiSystem::gitlab) {
    write_control(fmt::format("\033[0Ksection_end:{}:{}\r\033[0K\n", std::time(nullptr), name_));
  }
}

}  // namespace triptych::app
