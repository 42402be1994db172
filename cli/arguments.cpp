// SPDX-License-Identifier: Apache-2.0
#include "arguments.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>

#include "bench_arguments.hpp"
#include "bus_arguments.hpp"
#include "error_text.hpp"
#include "keys_arguments.hpp"
#include "rave/base/names.hpp"
#include "rave/base/result.hpp"
#include "watch_arguments.hpp"

namespace rave::cli {
namespace {

/// All options of all subcommands, one of which is used.
struct Everything {
  RunCommand run;
  RobotCommand robot;
  EnvCommand env;
  CheckCommand check;
  DriversCommand drivers;
  DescribeCommand describe;
  NewCommand make;
  SchemaCommand schema;
  InfoCommand info;
  VerifyCommand verify;
  PlayCommand play;
  GapCommand gap;
  PsCommand ps;
  StopCommand stop;
  ArmCommand arm;
  SetCommand set;
  HandOverCommand hand_over;
  ShadowCommand shadow;
  EditCommand edit;
  HoldCommand hold;
  BenchSwarmCommand bench_swarm;
  BenchCompareCommand bench_compare;
  KeysCommands keys;
  TopCommand top;
  DoctorCommand doctor;
};

void add_plugins(CLI::App& app, std::vector<std::string>& folders) {
  app.add_option("--plugins", folders,
                 "Folder with more plug-ins; may be given several times and wins over "
                 "RAVE_PLUGIN_PATH and the built-in ones")
      ->type_name("DIR")
      ->take_all()
      ->allow_extra_args(false);
}

/// What `rave run` and `rave play` have in common.
void add_run_options(CLI::App& app, RunCommand& c) {
  app.add_option("--output", c.output, "Folder for what the run leaves [runs/<time>-<scenario>]")
      ->type_name("DIR");
  app.add_option("--seed", c.seed, "Another seed of all chance")->type_name("N");
  app.add_option("--threads", c.threads, "Threads; they do not change the result")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  app.add_option("--duration", c.duration_s, "Simulated time in seconds")
      ->type_name("S")
      ->check(CLI::Range(1e-4, 1e9));
  app.add_option("--pace", c.pace, "max, realtime, or a factor such as 10x")->type_name("PACE");
  app.add_flag("--no-picture", c.no_picture, "Do not draw picture.svg and picture.png");
  app.add_flag("--no-record", c.no_record, "Do not write run.mcap");
  app.add_flag("--arm", c.arm, "Arm all robots at the start: real ones may drive at once");
  app.add_flag("--quiet", c.quiet, "Print errors and problems only");
  add_plugins(app, c.plugins);
}

void add_run(CLI::App& root, RunCommand& c) {
  CLI::App& app = *root.add_subcommand("run", "Run a scenario");
  app.add_option("scenario", c.scenario, "A file, a folder with scenario.yaml, or a name")
      ->required()
      ->type_name("SCENARIO");
  add_run_options(app, c);
  app.add_option("--processes", c.processes, "Share the robots evenly among so many processes")
      ->type_name("N")
      ->check(CLI::Range(1, 100));
  add_bus_options(app, c.bus);
  app.footer(
      "Exit code: 0 if the run was whole and its checks hold, 1 if not, 2 for bad input.\n"
      "Ctrl-C ends a run early and still writes its results; a second one kills it.\n"
      "`rave stop`, `arm`, `set`, `edit`, `pause` and `ps` work from another terminal.\n\n"
      "Examples:\n"
      "  rave run mixed-reality --pace 10x\n"
      "  rave run my/scenario.yaml --seed 7 --duration 30 --output results");
}

void add_hosts(CLI::App& root, Everything& all) {
  RunCommand& robot = all.robot.run;
  CLI::App& host = *root.add_subcommand("robot", "Run the robots of one host of a scenario");
  host.add_option("scenario", robot.scenario, "A file, a folder with scenario.yaml, or a name")
      ->required()
      ->type_name("SCENARIO");
  host.add_option("--host", all.robot.host, "Which one, as the scenario names it")
      ->required()
      ->type_name("NAME");
  host.add_option("--wait-for-manager", all.robot.manager_patience_s,
                  "Give up after so many seconds without an environment manager [never]")
      ->type_name("S")
      ->check(CLI::Range(0.1, 1e9));
  add_run_options(host, robot);
  host.add_option("--processes", robot.processes, "As of `rave env`")
      ->type_name("N")
      ->check(CLI::Range(2, 100));
  add_bus_options(host, robot.bus);
  host.footer(
      "It waits for the environment manager of the run (`rave env`, or `rave run` of the same\n"
      "scenario), however late that comes, and goes on with the next one if it is lost; in real\n"
      "time also without one.\n"
      "Exit code: 0 if it took part from the first step to the last, 1 if not, 2 for bad input.\n\n"
      "Examples:\n"
      "  rave robot lab --host left\n"
      "  rave robot lab --host left --interface 192.168.1.7 --peer 192.168.1.2");

  RunCommand& env = all.env.run;
  CLI::App& manager =
      *root.add_subcommand("env", "Manage the world of a scenario that several hosts share");
  manager.add_option("scenario", env.scenario, "A file, a folder with scenario.yaml, or a name")
      ->required()
      ->type_name("SCENARIO");
  add_run_options(manager, env);
  manager
      .add_option("--processes", env.processes, "Share the robots evenly among host-1, host-2 ...")
      ->type_name("N")
      ->check(CLI::Range(2, 100));
  add_bus_options(manager, env.bus);
  manager.footer(
      "The hosts are started with `rave robot`, in any order. If it dies, another one goes on in\n"
      "its place. Exit code: 0 if the run was whole, 1 if not, 2 for bad input.\n\n"
      "Example:\n"
      "  rave env lab");
}

void add_check(CLI::App& root, CheckCommand& c) {
  CLI::App& app =
      *root.add_subcommand("check", "Check robot, world and scenario files, and draw them");
  app.add_option("files", c.files, "Which of the three a file is, is seen by its keys")
      ->required()
      ->type_name("FILE");
  app.add_flag("--expand", c.expand, "Print the file with all defaults");
  app.add_option("--draw", c.draw,
                 "Draw a robot with its sensors, or a world with the robots at their start")
      ->type_name("OUT.svg|OUT.png");
  add_plugins(app, c.plugins);
  app.footer(
      "Exit code: 0 if all files are right, 2 if not.\n\n"
      "Examples:\n"
      "  rave check robots/*.yaml\n"
      "  rave check robot.yaml --draw robot.svg\n"
      "  rave check scenario.yaml --expand > complete.yaml");
}

void add_drivers(CLI::App& root, DriversCommand& c) {
  CLI::App& app = *root.add_subcommand("drivers", "List the drivers and programs there are");
  app.add_option("--kind", c.kind, "Only one kind, such as virtual_sensor or program")
      ->type_name("KIND");
  auto* const json = app.add_flag("--json", c.json, "For other programs");
  app.add_flag("--markdown-reference", c.markdown, "The whole reference as one page")
      ->excludes(json);
  add_plugins(app, c.plugins);
  app.footer(
      "Examples:\n"
      "  rave drivers --kind program\n"
      "  rave drivers --plugins my_driver/build");
}

void add_describe(CLI::App& root, DescribeCommand& c) {
  CLI::App& app = *root.add_subcommand("describe", "Say what a driver or program is and takes");
  app.add_option("driver", c.driver, "Its name; `rave drivers` lists them")
      ->required()
      ->type_name("DRIVER");
  auto* const json = app.add_flag("--json", c.json, "For other programs");
  app.add_flag("--markdown", c.markdown, "As a section of a page")->excludes(json);
  add_plugins(app, c.plugins);
  app.footer("Example:\n  rave describe virtual_laser");
}

void add_new(CLI::App& root, NewCommand& c) {
  CLI::App& app = *root.add_subcommand("new", "Begin a robot program or driver of your own");
  app.add_option("kind", c.kind, "program or driver")->required()->type_name("KIND");
  app.add_option("name", c.name, "In lower_snake_case")->required()->type_name("NAME");
  app.add_option("--directory", c.directory, "Where [NAME in this folder]")->type_name("DIR");
  app.footer("Example:\n  rave new program follow_wall");
}

void add_schema(CLI::App& root, SchemaCommand& c) {
  CLI::App& app = *root.add_subcommand("schema", "Print the JSON Schema of a kind of file");
  app.add_option("kind", c.kind, "robot, world or scenario")->required()->type_name("KIND");
  app.footer("Example:\n  rave schema robot > robot.schema.json");
}

void add_info(CLI::App& root, InfoCommand& c) {
  CLI::App& app = *root.add_subcommand("info", "Say what is in the record of a run");
  app.add_option("file", c.file, "A run.mcap, or the folder of a run")
      ->required()
      ->type_name("FILE");
  app.add_flag("--json", c.json, "For other programs");
  app.footer("Example:\n  rave info runs/20260101-120000-mixed-reality");
}

void add_verify(CLI::App& root, VerifyCommand& c) {
  CLI::App& app =
      *root.add_subcommand("verify", "Run what a record holds again and compare it to the bit");
  app.add_option("file", c.file, "A run.mcap, or the folder of a run")
      ->required()
      ->type_name("FILE");
  app.add_option("--threads", c.threads, "Threads; they do not change the result")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  app.add_flag("--quiet", c.quiet, "Print errors and differences only");
  add_plugins(app, c.plugins);
  app.footer(
      "Exit code: 0 if every step is the same, 1 if not (the first step, robot and channel that\n"
      "differ are named), 2 if it cannot be run again: a live run, or input files that are "
      "missing.\n\n"
      "Example:\n"
      "  rave verify runs/20260101-120000-mixed-reality");
}

void add_play(CLI::App& root, PlayCommand& c) {
  CLI::App& app = *root.add_subcommand(
      "play", "Play robots of a record as recorded real robots in a new scenario");
  app.add_option("file", c.file, "A run.mcap, or the folder of a run")
      ->required()
      ->type_name("FILE");
  app.add_option("--robot", c.robots, "One of the recorded robots; may be repeated [all]")
      ->type_name("NAME")
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--anew", c.anew,
                 "A virtual sensor that senses the new world instead of being played; may be "
                 "repeated")
      ->type_name("SENSOR")
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--world", c.world, "A world file [the world of the record]")->type_name("FILE");
  app.add_option("--program", c.program,
                 "Program that gets the readings; its commands are ignored [none]")
      ->type_name("NAME");
  app.add_option("--start", c.start_s, "Time of the record to start at, in seconds [0]")
      ->type_name("S")
      ->check(CLI::Range(0.0, 1e9));
  app.add_option("--write", c.write, "Only write the scenario, into this folder")->type_name("DIR");
  add_run_options(app, c.run);
  app.footer(
      "The scenario is left in the folder `played` of the run; simulated robots can be added to "
      "it\n"
      "by hand. Exit code: as of `rave run`.\n\n"
      "Examples:\n"
      "  rave play runs/20260101-120000-mixed-reality --robot walker-3 --anew laser\n"
      "  rave play run.mcap --robot hunter --program wander --write my/scenario");
}

void add_report(CLI::App& root, GapCommand& c) {
  CLI::App& parent = *root.add_subcommand("report", "Draw conclusions from the record of a run");
  parent.require_subcommand(1);
  parent.footer("Example:\n  rave report gap run.mcap --robot walker-3");
  CLI::App& app = *parent.add_subcommand(
      "gap", "Compare a recorded robot with its simulated twin under the same commands");
  app.add_option("file", c.file, "A run.mcap, or the folder of a run")
      ->required()
      ->type_name("FILE");
  app.add_option("--robot", c.robot, "The recorded robot [the only one]")->type_name("NAME");
  app.add_option("--twin", c.twin, "Robot file whose simulated actuator drives the twin [its own]")
      ->type_name("FILE");
  app.add_option("--commands", c.commands,
                 "Velocity sensor that tells the commands [what reached the actuator]")
      ->type_name("SENSOR");
  app.add_flag("--truth", c.truth, "Compare with the true pose, not with the reported one");
  app.add_option("--window", c.window_s, "Length of the windows that start anew, in seconds [10]")
      ->type_name("S")
      ->check(CLI::Range(1e-3, 1e6));
  app.add_option("--output", c.output, "Folder for picture and numbers [that of the record]")
      ->type_name("DIR");
  app.add_flag("--json", c.json, "Print the numbers as JSON");
  add_plugins(app, c.plugins);
  app.footer(
      "The twin starts where the robot was first known to be and drives in an empty world.\n\n"
      "Examples:\n"
      "  rave report gap runs/20260101-120000-corridor --robot create --twin robots/twin.yaml\n"
      "  rave report gap run.mcap --robot real-3 --commands commanded --twin robots/wanderer.yaml");
}

void add_run_name(CLI::App& app, std::string& run) {
  app.add_option("run", run, "Its name, process id or scenario; not needed for the only one")
      ->type_name("RUN");
}

void take_robot(CLI::App& app, std::string& robot) {
  app.add_option("--robot", robot, "Only this one [all]")->type_name("NAME");
}

void add_control(CLI::App& root, Everything& all) {
  CLI::App& ps = *root.add_subcommand("ps", "List the runs that go on");
  ps.add_flag("--robots", all.ps.robots, "Also each robot, and whether it may move");

  CLI::App& stop = *root.add_subcommand("stop", "Make robots of a run stand until released");
  add_run_name(stop, all.stop.run);
  take_robot(stop, all.stop.robot);
  stop.add_flag("--all", all.stop.all, "Every robot of every run");
  stop.footer(
      "No program can move a stopped robot. `rave arm --release` lets it go again.\n\n"
      "Examples:\n"
      "  rave stop\n"
      "  rave stop predator-prey --robot predator");

  CLI::App& arm = *root.add_subcommand("arm", "Let real robots of a run move");
  add_run_name(arm, all.arm.run);
  take_robot(arm, all.arm.robot);
  arm.add_flag("--release", all.arm.release, "Also those that were stopped");

  CLI::App& set = *root.add_subcommand("set", "Change a parameter of a robot while it runs");
  set.add_option("words", all.set.words, "[RUN] ROBOT KEY VALUE")
      ->required()
      ->expected(3, 4)
      ->type_name("WORD");
  set.footer(
      "KEY is program.PARAM, controller.NAME.PARAM, actuator.NAME.PARAM or body.scale.\n\n"
      "Examples:\n"
      "  rave set prey program.max_speed_mps 0.6\n"
      "  rave set predator-prey prey body.scale 1.5");

  add_run_name(*root.add_subcommand("pause", "Hold a run that is not live"), all.hold.run);
  add_run_name(*root.add_subcommand("resume", "Let a paused run go on"), all.hold.run);
  CLI::App& step = *root.add_subcommand("step", "Do steps of a paused run");
  add_run_name(step, all.hold.run);
  step.add_option("--count", all.hold.count, "How many [1]")
      ->type_name("N")
      ->check(CLI::Range(1, 1'000'000'000));
}

void add_hand_over(CLI::App& root, Everything& all) {
  HandOverCommand& c = all.hand_over;
  CLI::App& app = *root.add_subcommand("hand-over", "Give a robot its other drivers while it runs");
  app.add_option("robot", c.robot, "One whose entry in the scenario has `twin:`")
      ->required()
      ->type_name("ROBOT");
  app.add_option("to", c.to, "real or simulated; or first (those of `file:`) or twin")
      ->required()
      ->type_name("DRIVERS");
  app.add_option("--run", c.run, "Name, process id or scenario of the run [the only one]")
      ->type_name("RUN");
  app.footer(
      "The drivers are opened, the robot is brought to stand, and between two steps it changes.\n"
      "Its program and its controllers go on. What keeps it from changing is told, and then\n"
      "everything is as it was.\n\n"
      "Examples:\n"
      "  rave hand-over create real\n"
      "  rave hand-over create simulated --run corridor");

  CLI::App& shadow = *root.add_subcommand(
      "shadow", "How far real robots are from their simulated twins that run beside them");
  add_run_name(shadow, all.shadow.run);
  take_robot(shadow, all.shadow.robot);
  shadow.add_flag("--reset", all.shadow.reset, "Put the twin where the robot is");
  shadow.add_flag("--json", all.shadow.json, "Print the numbers as JSON");
}

void add_name(CLI::App& app, std::string& name) {
  app.add_option("name", name, "Of the obstacle; `rave edit list` has them all")
      ->required()
      ->type_name("NAME");
}

void add_place(CLI::App& app, std::string& at) {
  app.add_option("--at", at, "X,Y or X,Y,DEG in metres and degrees; without DEG it is not turned")
      ->required()
      ->type_name("PLACE");
}

void add_edit(CLI::App& root, EditCommand& c) {
  CLI::App& app =
      *root.add_subcommand("edit", "Add, move and remove obstacles of a run while it goes");
  add_run_name(app, c.run);
  app.require_subcommand(1);
  CLI::App& add = *app.add_subcommand("add", "Put an obstacle somewhere");
  add.add_option("shape", c.shape, "box, disc or polygon")
      ->required()
      ->check(CLI::IsMember({"box", "disc", "polygon"}))
      ->type_name("SHAPE");
  add.add_option("--name", c.name, "What no other obstacle is called")
      ->required()
      ->type_name("NAME");
  add_place(add, c.at);
  add.add_option("--size", c.size, "LxW of a box, the radius of a disc, in metres")
      ->type_name("SIZE");
  add.add_option("--corners", c.corners, "Of a polygon, such as \"0,0 1,0 0.5,1\"")
      ->type_name("PLACES");
  add.add_option("--height", c.height, "LOW,HIGH above the floor [0,0.5]")->type_name("HEIGHT");
  add.add_option("--layer", c.layer, "virtual_obstacles or mapped_real [virtual_obstacles]")
      ->type_name("LAYER");
  add.add_option("--colour", c.colour, "For pictures, #rrggbb")->type_name("COLOUR");
  add.add_option("--barcode", c.barcode, "What landmark cameras read on it [none]")->type_name("N");
  CLI::App& move = *app.add_subcommand("move", "Put an obstacle elsewhere");
  add_name(move, c.name);
  add_place(move, c.at);
  add_name(*app.add_subcommand("remove", "Take an obstacle away"), c.name);
  app.add_subcommand("list", "Say which obstacles stand where");
  app.footer(
      "A change counts from the next step on; the answer says which that is. What would overlap a\n"
      "simulated robot is refused. Exit code: 0 if it was done, 1 if the run refuses, 2 for bad "
      "input.\n\n"
      "Examples:\n"
      "  rave edit add box --name crate --at 1,2,30 --size 0.5x0.3\n"
      "  rave edit move crate --at 2,2\n"
      "  rave edit predator-prey remove crate");
}

std::vector<std::string_view> subcommands_of(const CLI::App& root,
                                             std::vector<std::string>& names) {
  for (const CLI::App* app : root.get_subcommands(nullptr)) names.push_back(app->get_name());
  return {names.begin(), names.end()};
}

/// A word that is no subcommand, before CLI11 says something vague about it.
std::optional<Finished> unknown_subcommand(const CLI::App& root, const std::string& word) {
  std::vector<std::string> names;
  const std::vector<std::string_view> views = subcommands_of(root, names);
  if (word.starts_with("-") || std::find(views.begin(), views.end(), word) != views.end()) {
    return std::nullopt;
  }
  const auto error = fail(ErrorCode::kInvalidArgument, "there is no subcommand `{}`{}", word,
                          suggestion(word, views));
  return Finished{complain(error.value())};
}

/// The subcommand that was named, as far down as names went.
const CLI::App& chosen_app(const CLI::App& root) {
  const CLI::App* app = &root;
  while (!app->get_subcommands().empty()) app = app->get_subcommands().front();
  return *app;
}

/// `rave report gap`
std::string full_name(const CLI::App& root) {
  std::string name = "rave";
  for (const CLI::App* app = &root; !app->get_subcommands().empty();) {
    app = app->get_subcommands().front();
    name += " " + app->get_name();
  }
  return name;
}

/// Says what is wrong with an option, and of an unknown one which is nearest.
Finished usage_error(const CLI::App& root, const CLI::ParseError& e) {
  const CLI::App& app = chosen_app(root);
  std::string message = e.what();
  const std::vector<std::string> extras = app.remaining();
  std::vector<std::string> below;
  const std::vector<std::string_view> subcommands = subcommands_of(app, below);
  if (!subcommands.empty() && !extras.empty() && !extras.front().starts_with("-")) {
    // Of `rave keys shwo`; the first word of all has been looked at before.
    message = fmt::format("there is no subcommand `{} {}`{}", app.get_name(), extras.front(),
                          suggestion(extras.front(), subcommands));
  } else if (dynamic_cast<const CLI::ExtrasError*>(&e) != nullptr && !extras.empty()) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    const std::vector<std::string_view> views(names.begin(), names.end());
    const std::string word = extras.front().substr(0, extras.front().find('='));
    message = word.starts_with("-")
                  ? fmt::format("there is no option `{}`{}", word, suggestion(word, views))
                  : fmt::format("`{}` is one word too many", word);
  }
  while (!message.empty() && message.back() == '\n') message.pop_back();
  const std::string name = full_name(root);
  complain({ErrorCode::kInvalidArgument, message, {}});
  put(stderr, fmt::format("`{} --help` says how it is used\n", name));
  return {kBadInput};
}

EditCommand chosen_edit(const std::string& name, EditCommand edit) {
  using What = EditCommand::What;
  edit.what = name == "add"      ? What::kAdd
              : name == "move"   ? What::kMove
              : name == "remove" ? What::kRemove
                                 : What::kList;
  return edit;
}

Command chosen_command(const CLI::App& root, const Everything& all) {
  const std::string name = root.get_subcommands().front()->get_name();
  if (name == "run") return all.run;
  if (name == "robot") return all.robot;
  if (name == "env") return all.env;
  if (name == "check") return all.check;
  if (name == "drivers") return all.drivers;
  if (name == "describe") return all.describe;
  if (name == "new") return all.make;
  if (name == "schema") return all.schema;
  if (name == "info") return all.info;
  if (name == "verify") return all.verify;
  if (name == "play") return all.play;
  if (name == "report") return all.gap;
  if (name == "ps") return all.ps;
  if (name == "stop") return all.stop;
  if (name == "arm") return all.arm;
  if (name == "set") return all.set;
  if (name == "hand-over") return all.hand_over;
  if (name == "shadow") return all.shadow;
  if (name == "bench") {
    if (chosen_app(root).get_name() == "swarm") return all.bench_swarm;
    return all.bench_compare;
  }
  if (name == "keys") {
    const std::string what = chosen_app(root).get_name();
    if (what == "new") return all.keys.make;
    if (what == "add") return all.keys.add;
    return all.keys.show;
  }
  if (name == "top") return all.top;
  if (name == "doctor") return all.doctor;
  if (name == "edit") return chosen_edit(chosen_app(root).get_name(), all.edit);
  HoldCommand hold = all.hold;
  if (name == "pause") return hold;
  if (name == "resume" || name == "step") {
    hold.what = name == "step" ? HoldCommand::What::kStep : HoldCommand::What::kResume;
    return hold;
  }
  return VersionCommand{};
}

}  // namespace

Command parse_arguments(int argc, const char* const* argv) {
  Everything all;
  bool version = false;
  CLI::App root("Real and simulated mobile robots in one world", "rave");
  root.require_subcommand(0, 1);
  root.add_flag("--version", version, "What this build is");
  add_run(root, all.run);
  add_hosts(root, all);
  add_check(root, all.check);
  add_drivers(root, all.drivers);
  add_describe(root, all.describe);
  add_new(root, all.make);
  add_schema(root, all.schema);
  add_info(root, all.info);
  add_verify(root, all.verify);
  add_play(root, all.play);
  add_report(root, all.gap);
  add_control(root, all);
  add_hand_over(root, all);
  add_edit(root, all.edit);
  add_bench(root, all.bench_swarm, all.bench_compare);
  add_keys_commands(root, all.keys);
  add_top(root, all.top);
  add_doctor(root, all.doctor);
  root.add_subcommand("version", "What this build is, and which plug-ins fit it");
  root.footer(
      "Examples:\n"
      "  rave run mixed-reality\n"
      "  rave check my/robot.yaml --draw robot.svg\n"
      "  rave describe virtual_laser\n\n"
      "`rave SUBCOMMAND --help` says more.");
  if (argc > 1) {
    if (const auto finished = unknown_subcommand(root, argv[1])) return *finished;
  }
  try {
    root.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    put(stdout, chosen_app(root).help());
    return Finished{kGood};
  } catch (const CLI::ParseError& e) {
    return usage_error(root, e);
  }
  if (version) return VersionCommand{};
  if (root.get_subcommands().empty()) {
    put(stderr, root.help());
    return Finished{kBadInput};
  }
  return chosen_command(root, all);
}

}  // namespace rave::cli
