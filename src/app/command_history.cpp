// The `history` command compares the stores from many days or commits in chronological order.

#include <fmt/format.h>

#include <filesystem>

#include "app/arguments.hpp"
#include "app/registry.hpp"
#include "app/terminal.hpp"
#include "app/verdicts.hpp"
#include "comparison/history.hpp"
#include "core/output_files.hpp"
#include "report/exports/comparison_json.hpp"
#include "report/page/history_page.hpp"
#include "report/screen/comparison_screen.hpp"

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
    std::vector<core::NamedFile> read;
    for (const std::string& store : arguments.stores) read.push_back({"STORE", store});
    core::refuse_overwriting(read, {{"--out", arguments.out}});
    core::require_writable_file(arguments.out);
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
  for (record::Store* store : comparison::sorted_by_time(given)) {
    measure::Truths truths(registry.find_suite(), *store);
    builder.add(*store, truths);
  }
  if (builder.devices().empty()) {
    throw core::NotSupported(
        "the stores contain no run on a matching device; `triptych devices` lists the devices of "
        "this machine");
  }
  const core::Json json = report::to_json(builder.devices());
  if (!arguments.out.empty()) core::write_text(arguments.out, report::history_page(json));
  if (arguments.json) {
    print(json);
  } else {
    print_lines(report::screen_of(builder.devices()));
    if (!arguments.out.empty()) print_out("{}\n", arguments.out);
  }
  return core::ExitCode::pass;
}

}  // namespace

void add_history_command(Commands& commands) {
  auto [command, arguments] = commands.add("history",
                                           "Show how cost and frame times changed from store to "
                                           "store, and identify the first store that is worse",
                                           history);
  command.add_option("STORE", arguments.stores, "Stores that contain the same plans, in any order")
      ->required();
  add_devices_option(command, arguments.devices);
  command.add_option("--out", arguments.out, "Also write an HTML page, such as history.html");
  command.add_flag("--json", arguments.json, "Print machine-readable JSON");
  add_example(command, "triptych history monday.sqlite tuesday.sqlite --out history.html");
}

}  // namespace triptych::app
