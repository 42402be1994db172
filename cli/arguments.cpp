// SPDX-License-Identifier: Apache-2.0
#include "arguments.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <string_view>
#include <vector>

#include "command_tree.hpp"
#include "commands/version.hpp"
#include "error_text.hpp"
#include "help.hpp"
#include "usage_error.hpp"

namespace rave::cli {
namespace {

/// Headings of the help. A command that is not named here controls a run in progress.
void group_commands(CLI::App& root) {
  using Names = std::initializer_list<std::string_view>;
  struct Group {
    const char* heading;
    Names names;
  };
  const Group groups[] = {
      {"Start a run", {"run", "robot", "env"}},
      {"Files, drivers and programs", {"check", "drivers", "describe", "new", "schema"}},
      {"Experiments", {"sweep", "branch", "diff"}},
      {"Recordings", {"info", "verify", "play", "export", "report"}},
      {"Page in the browser", {"gui", "people"}},
      {"Several machines", {"keys", "doctor"}},
      {"This build", {"bench", "version"}},
  };
  for (CLI::App* const app : root.get_subcommands(nullptr)) {
    app->group("Runs in progress");
    for (const Group& group : groups) {
      for (const std::string_view name : group.names) {
        if (app->get_name() == name) app->group(group.heading);
      }
    }
  }
}

/// What a run writes, and what is made of its recording, is for the user alone: it has what people
/// said and what cameras and sensors saw. What these commands write has none of that.
void write_privately(const CLI::App& root) {
  constexpr std::string_view kOthers[] = {"check",  "drivers", "describe", "new",
                                          "schema", "keys",    "doctor",   "bench"};
  for (const CLI::App* const used : root.get_subcommands()) {
    if (std::ranges::find(kOthers, used->get_name()) != std::end(kOthers)) return;
  }
  ::umask(::umask(0) | 077U);
}

/// `rave help run` is `rave run --help`.
int help(CLI::App& root, int argc, const char* const* argv) {
  std::vector<const char*> words = {argv[0]};
  words.insert(words.end(), argv + 2, argv + argc);
  words.push_back("--help");
  if (argc > 2) {
    if (const auto finished = unknown_subcommand(root, argv[2])) return *finished;
  }
  try {
    root.parse(static_cast<int>(words.size()), words.data());
  } catch (const CLI::CallForHelp&) {
    put(stdout, root.help());
    return kGood;
  } catch (const CLI::ParseError& e) {
    return usage_error(root, e);
  }
  return kBadInput;
}

}  // namespace

int run_command_line(int argc, const char* const* argv) {
  Command chosen;
  bool wants_version = false;
  CLI::App root("Real and simulated mobile robots in one world", "rave");
  root.formatter(std::make_shared<Help>());
  root.require_subcommand(0, 1);
  root.add_flag("--version", wants_version, "Print the version and exit");
  add_run_commands(root, chosen);
  add_file_commands(root, chosen);
  add_record_commands(root, chosen);
  add_control_commands(root, chosen);
  add_bench_commands(root, chosen);
  add_experiment_commands(root, chosen);
  add_keys_commands(root, chosen);
  add_people_commands(root, chosen);
  add_watch_commands(root, chosen);
  root.add_subcommand("version", "Print the version, and the interfaces that plug-ins must match")
      ->callback([&chosen] { chosen = version; });
  root.footer(
      "Examples:\n"
      "  rave run mixed-reality\n"
      "  rave check my/robot.yaml --draw robot.svg\n"
      "  rave describe virtual_laser\n\n"
      "Help on one command: `rave SUBCOMMAND --help`, or `man rave-SUBCOMMAND`.");
  group_commands(root);
  // Not for people: docs_commands checks the command lines of pages with it. Nothing is run.
  const bool parse_only = argc > 1 && std::string_view(argv[1]) == "--parse-only";
  if (parse_only) {
    --argc;
    ++argv;
  }
  // Not for people: tools make man pages and shell completion from it.
  if (argc == 2 && std::string_view(argv[1]) == "--command-tree") {
    put(stdout, command_tree(root));
    return kGood;
  }
  if (argc > 1 && std::string_view(argv[1]) == "help") return help(root, argc, argv);
  if (argc > 1) {
    if (const auto finished = unknown_subcommand(root, argv[1])) return *finished;
  }
  try {
    root.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    put(stdout, root.help());
    return kGood;
  } catch (const CLI::ParseError& e) {
    return usage_error(root, e);
  }
  if (parse_only) return kGood;
  if (wants_version) chosen = version;
  if (!chosen) {
    put(stderr, root.help());
    return kBadInput;
  }
  write_privately(root);
  const Result<int> code = chosen();
  return code ? *code : complain(code.error());
}

}  // namespace rave::cli
