// history: stores of many days or commits, one after the other.

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/arguments.hpp"
#include "app/judging.hpp"
#include "app/paths.hpp"
#include "app/registry.hpp"
#include "app/truth.hpp"
#include "comparison/history.hpp"
#include "core/json.hpp"
#include "core/json_text.hpp"
#include "report/history_page.hpp"

namespace triptych::app {
namespace {

struct HistoryArguments {
  std::vector<std::string> stores;
  std::vector<std::string> devices;
  std::string out;
  bool json = false;
};

core::ExitCode history(const HistoryArguments& arguments) {
  if (!arguments.out.empty()) {
    std::vector<NamedFile> read;
    for (const std::string& store : arguments.stores) read.push_back({"STORE", store});
    refuse_overwriting(read, {{"--out", arguments.out}});
    require_writable(std::filesystem::path(arguments.out).parent_path());
  }
  const Registry registry = make_registry();
  std::vector<record::Store> stores;
  stores.reserve(arguments.stores.size());
  std::vector<record::Store*> given;
  for (const std::string& file : arguments.stores) {
    stores.push_back(open_to_judge(file));
    given.push_back(&stores.back());
  }
  comparison::HistoryBuilder builder(arguments.devices);
  for (record::Store* store : comparison::in_order(given)) {
    Truths truths(registry, *store);
    builder.add(*store, known_truth(truths));
  }
  if (builder.devices().empty()) {
    throw core::NotSupported("the stores hold no run of such a device: see `triptych devices`");
  }
  const core::Json json = comparison::to_json(builder.devices());
  if (!arguments.out.empty()) write_text(arguments.out, report::history_page(json));
  fmt::print("{}", arguments.json ? core::json_text(json, 2) + "\n"
                                  : comparison::to_text(builder.devices()));
  if (!arguments.out.empty()) fmt::print("{}\n", arguments.out);
  return core::ExitCode::pass;
}

}  // namespace

void add_history_command(Commands& commands) {
  auto arguments = std::make_shared<HistoryArguments>();
  CLI::App* command = commands.add(
      "history", "Cost, time and changes over stores of many days, and the first that was worse",
      [arguments] { return history(*arguments); });
  command->add_option("STORE", arguments->stores, "Stores of the same plans, in any order")
      ->required();
  command->add_option("--device", arguments->devices, "Glob: only these (repeatable)");
  command->add_option("--out", arguments->out, "Also write a page, such as history.html");
  command->add_flag("--json", arguments->json, "Print everything as JSON");
}

}  // namespace triptych::app
