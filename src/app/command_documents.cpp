// Generates the manual page and the shell completion from the definitions of the commands, so that
// no option can be missing. The build writes both files next to the program, and `cmake --install`
// installs them.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <string_view>
#include <vector>

#include "app/arguments.hpp"
#include "app/registry.hpp"
#include "app/version.hpp"

namespace triptych::app {
namespace {

// Escapes text for a manual page, in which backslashes, hyphens and the first character of a line
// have a special meaning.
std::string roff_escaped(std::string_view text) {
  std::string escaped = "\\&";
  for (const char each : text) {
    if (each == '\\') {
      escaped += "\\e";
    } else if (each == '-') {
      escaped += "\\-";
    } else if (each == '\n') {
      escaped += "\n.br\n\\&";
    } else {
      escaped += each;
    }
  }
  return escaped;
}

// Returns the commands that --help lists.
std::vector<const CLI::App*> shown_commands(const CLI::App& program) {
  return program.get_subcommands(
      [](const CLI::App* each) { return !each->get_group().empty() && !each->get_name().empty(); });
}

std::vector<const CLI::Option*> shown_options(const CLI::App& command) {
  return command.get_options([](const CLI::Option* each) { return !each->get_group().empty(); });
}

bool takes_a_value(const CLI::Option& option) {
  return !option.get_positional() && option.get_items_expected_max() > 0;
}

std::string option_entry(const CLI::Option& option) {
  const std::string name =
      option.get_positional() ? option.get_name(true) : option.get_name(false, true);
  const std::string_view value = takes_a_value(option) ? " VALUE" : "";
  const std::string default_text = option.get_default_str();
  return fmt::format(".TP\n.B {}{}\n{}{}\n", roff_escaped(name), value,
                     roff_escaped(option.get_description()),
                     default_text.empty() ? "" : roff_escaped(" [" + default_text + "]"));
}

std::string command_section(const CLI::App& command) {
  std::string text = fmt::format(".SS {}\n{}\n", roff_escaped(command.get_name()),
                                 roff_escaped(command.get_description()));
  for (const CLI::Option* option : shown_options(command)) text += option_entry(*option);
  const std::string footer = command.get_footer();
  const std::size_t example = footer.size() - command.get_parent()->get_footer().size();
  if (example > 0) text += fmt::format(".PP\n{}\n", roff_escaped(footer.substr(0, example - 2)));
  return text;
}

constexpr std::string_view environment = R"(.SH ENVIRONMENT
.TP
.B TRIPTYCH_DATA
Folder with the subfolders volumes/ and particles/, from which plans load their data files.
.TP
.B XDG_CACHE_HOME
Folder whose subfolder triptych/ caches the code that drivers have compiled (default: ~/.cache).
.PP
Environment variables that affect a driver are part of the device's key.
.B triptych devices
lists these variables.
)";

std::string manual(const CLI::App& program) {
  std::string text = fmt::format(
      ".TH TRIPTYCH 1 \"\" \"triptych {}\"\n.SH NAME\ntriptych \\- test GPU drivers by comparing "
      "images, amount of work and cost\n.SH SYNOPSIS\n.B triptych\nCOMMAND [OPTION]... "
      "[PLAN]...\n.SH DESCRIPTION\n{}.\n.PP\n.B triptych gate \\-\\-measure\nmeasures and judges "
      "every device of this machine.\n.SH COMMANDS\n",
      roff_escaped(version()), roff_escaped(program.get_description()));
  for (const CLI::App* command : shown_commands(program)) text += command_section(*command);
  text += fmt::format(".SH EXIT STATUS\n{}\n", roff_escaped(program.get_footer()));
  return text.append(environment);
}

// Returns the words that the shell offers as completions after a command: the command's options
// and, if it takes plans, the names of all plans in the suites.
std::string completion_words(const CLI::App& command, const std::vector<std::string>& plans) {
  std::string words;
  bool takes_plans = false;
  for (const CLI::Option* option : shown_options(command)) {
    takes_plans |= option->get_positional() && option->get_name(true) == "PLAN";
    for (const std::string& name : option->get_lnames()) words += " --" + name;
  }
  return takes_plans ? fmt::format("{} {}", words, fmt::join(plans, " ")) : words;
}

std::string completion(const CLI::App& program) {
  const std::vector<std::string> plans = make_registry().plan_names();
  std::string names;
  std::string cases;
  for (const CLI::App* command : shown_commands(program)) {
    names += " " + command->get_name();
    cases += fmt::format("    {}) words=\"{}\" ;;\n", command->get_name(),
                         completion_words(*command, plans));
  }
  return fmt::format(
      "# Bash completion for triptych. Completes file names if no other word matches.\n_triptych() "
      "{{\n"
      "  local words=\"{} --help --version\"\n"
      "  [ \"$COMP_CWORD\" -eq 1 ] || case ${{COMP_WORDS[1]}} in\n{}    *) words= ;;\n  esac\n"
      "  COMPREPLY=($(compgen -W \"$words\" -- \"$2\"))\n}}\n"
      "complete -o default -F _triptych triptych\n",
      names, cases);
}

void add(Commands& commands, const std::string& name, const std::string& summary,
         std::string (*text)(const CLI::App&)) {
  CLI::App& command = commands.add(name, summary, [&program = commands.program, text] {
    fmt::print("{}", text(program));
    return core::ExitCode::pass;
  });
  command.group("");  // hidden from --help, because only the build calls it
}

}  // namespace

void add_document_commands(Commands& commands) {
  add(commands, "manual", "Print the manual page", manual);
  add(commands, "completion", "Print the bash completion script", completion);
}

}  // namespace triptych::app
