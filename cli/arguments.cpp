// SPDX-License-Identifier: Apache-2.0
#include "arguments.hpp"

#include <initializer_list>
#include <memory>
#include <string_view>
#include <vector>

#include "bench_arguments.hpp"
#include "command_tree.hpp"
#include "control_arguments.hpp"
#include "error_text.hpp"
#include "file_arguments.hpp"
#include "help.hpp"
#include "keys_arguments.hpp"
#include "people_arguments.hpp"
#include "record_arguments.hpp"
#include "run_arguments.hpp"
#include "shared_arguments.hpp"
#include "usage_error.hpp"
#include "watch_arguments.hpp"

namespace rave::cli {
namespace {

/// All options of all subcommands, one of which is used.
struct Everything {
  RunCommands runs;
  FileCommands files;
  RecordCommands records;
  ControlCommands control;
  BenchSwarmCommand bench_swarm;
  BenchCompareCommand bench_compare;
  KeysCommands keys;
  PeopleCommand people;
  TopCommand top;
  DoctorCommand doctor;
};

EditCommand chosen_edit(const std::string& name, EditCommand edit) {
  using What = EditCommand::What;
  edit.what = name == "add"      ? What::kAdd
              : name == "move"   ? What::kMove
              : name == "remove" ? What::kRemove
                                 : What::kList;
  return edit;
}

Command chosen_command(const CLI::App& root, const Everything& all) {
  // CLI11 fills the structures of all subcommands; the chosen one is copied out of them here.
  const std::string name = root.get_subcommands().front()->get_name();
  if (name == "run") return all.runs.run;
  if (name == "robot") return all.runs.robot;
  if (name == "env") return all.runs.env;
  if (name == "check") return all.files.check;
  if (name == "drivers") return all.files.drivers;
  if (name == "describe") return all.files.describe;
  if (name == "new") return all.files.make;
  if (name == "schema") return all.files.schema;
  if (name == "info") return all.records.info;
  if (name == "verify") return all.records.verify;
  if (name == "play") return all.records.play;
  if (name == "export") return all.records.csv;
  if (name == "report") return all.records.gap;
  if (name == "gui") return all.records.gui;
  if (name == "ps") return all.control.ps;
  if (name == "stop") return all.control.stop;
  if (name == "arm") return all.control.arm;
  if (name == "set") return all.control.set;
  if (name == "hand-over") return all.control.hand_over;
  if (name == "shadow") return all.control.shadow;
  if (name == "drive") return all.control.drive;
  if (name == "goal") return all.control.goal;
  if (name == "say") return all.control.say;
  if (name == "place") return all.control.place;
  if (name == "bench") {
    if (chosen_app(root).get_name() == "swarm") return all.bench_swarm;
    return all.bench_compare;
  }
  if (name == "keys") {
    const std::string what = chosen_app(root).get_name();
    if (what == "new") return all.keys.make;
    if (what == "add") return all.keys.add;
    if (what == "web") return all.keys.web;
    if (what == "line") return all.keys.line;
    return all.keys.show;
  }
  if (name == "people") return chosen_people(chosen_app(root).get_name(), all.people);
  if (name == "top") return all.top;
  if (name == "doctor") return all.doctor;
  if (name == "edit") return chosen_edit(chosen_app(root).get_name(), all.control.edit);
  if (name == "end") return all.control.end;
  HoldCommand hold = all.control.hold;
  if (name == "pause") return hold;
  if (name == "resume" || name == "step") {
    hold.what = name == "step" ? HoldCommand::What::kStep : HoldCommand::What::kResume;
    return hold;
  }
  return VersionCommand{};
}

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

/// `rave help run` is `rave run --help`.
Finished help(CLI::App& root, int argc, const char* const* argv) {
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
    return Finished{kGood};
  } catch (const CLI::ParseError& e) {
    return usage_error(root, e);
  }
  return Finished{kBadInput};
}

}  // namespace

Command parse_arguments(int argc, const char* const* argv) {
  Everything all;
  bool version = false;
  CLI::App root("Real and simulated mobile robots in one world", "rave");
  root.formatter(std::make_shared<Help>());
  root.require_subcommand(0, 1);
  root.add_flag("--version", version, "Print the version and exit");
  add_run_commands(root, all.runs);
  add_file_commands(root, all.files);
  add_record_commands(root, all.records);
  add_control_commands(root, all.control);
  add_bench(root, all.bench_swarm, all.bench_compare);
  add_keys_commands(root, all.keys);
  add_people(root, all.people);
  add_top(root, all.top);
  add_doctor(root, all.doctor);
  root.add_subcommand("version", "Print the version, and the interfaces that plug-ins must match");
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
    return Finished{kGood};
  }
  if (argc > 1 && std::string_view(argv[1]) == "help") return help(root, argc, argv);
  if (argc > 1) {
    if (const auto finished = unknown_subcommand(root, argv[1])) return *finished;
  }
  try {
    root.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    put(stdout, root.help());
    return Finished{kGood};
  } catch (const CLI::ParseError& e) {
    return usage_error(root, e);
  }
  if (parse_only) return Finished{kGood};
  if (version) return VersionCommand{};
  if (root.get_subcommands().empty()) {
    put(stderr, root.help());
    return Finished{kBadInput};
  }
  return chosen_command(root, all);
}

}  // namespace rave::cli
