#include "measure/worker/own_program.hpp"

#include <filesystem>
#include <utility>

namespace triptych::measure {

std::string own_program() {
  return std::filesystem::read_symlink("/proc/self/exe").string();
}

std::vector<std::string> worker_command(std::string program, const std::vector<std::string>& more) {
  std::vector<std::string> command{std::move(program), "worker"};
  command.insert(command.end(), more.begin(), more.end());
  command.emplace_back("--device");
  return command;
}

}  // namespace triptych::measure
