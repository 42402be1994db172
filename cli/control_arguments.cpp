// SPDX-License-Identifier: Apache-2.0
#include "control_arguments.hpp"

#include "bus_arguments.hpp"
#include "shared_arguments.hpp"

namespace rave::cli {
namespace {

void add_run_name(CLI::App& app, std::string& run) {
  add_value(app, "run", run,
            "Its name, process id or scenario, or RUN@HOST; not needed for the only one", "RUN");
}

void add_robot_name(CLI::App& app, std::string& robot) {
  add_value(app, "--robot", robot, "Only this one [all]", "NAME");
}

void add_ps(CLI::App& root, PsCommand& c) {
  CLI::App& app = *root.add_subcommand("ps", "List the runs that go on");
  app.add_flag("--robots", c.robots, "Also each robot, and whether it may move");
  app.add_flag("--network", c.network,
               "Also the runs of several processes on the bus, those of other machines among them; "
               "the options below mean it, too");
  add_network_options(app, c.bus);
  app.footer(
      "On the bus runs are looked for 1.5 s, or 3 s beyond this machine. A run is named there by "
      "the\n"
      "beginning of its number; one of this machine that is on the bus is listed under both "
      "names.\n\n"
      "Examples:\n"
      "  rave ps\n"
      "  rave ps --interface 192.168.1.9 --peer 192.168.1.2");
}

void add_stop(CLI::App& root, StopCommand& c) {
  CLI::App& app = *root.add_subcommand("stop", "Make robots of a run stand until released");
  add_run_name(app, c.run);
  add_robot_name(app, c.robot);
  app.add_flag("--all", c.all, "Every robot of every run on this machine, none of other machines");
  add_network_options(app, c.bus);
  app.footer(
      "No program can move a stopped robot. `rave arm --release` lets it go again.\n\n"
      "Examples:\n"
      "  rave stop\n"
      "  rave stop predator-prey --robot predator");
}

void add_arm(CLI::App& root, ArmCommand& c) {
  CLI::App& app = *root.add_subcommand("arm", "Let real robots of a run move");
  add_run_name(app, c.run);
  add_robot_name(app, c.robot);
  app.add_flag("--release", c.release, "Also those that were stopped");
  add_network_options(app, c.bus);
}

void add_set(CLI::App& root, SetCommand& c) {
  CLI::App& app = *root.add_subcommand("set", "Change a parameter of a robot while it runs");
  add_word(app, "words", c.words, "[RUN] ROBOT KEY VALUE", "WORD")->expected(3, 4);
  add_network_options(app, c.bus);
  app.footer(
      "KEY is program.PARAM, controller.NAME.PARAM, actuator.NAME.PARAM or body.scale.\n\n"
      "Examples:\n"
      "  rave set prey program.max_speed_mps 0.6\n"
      "  rave set predator-prey prey body.scale 1.5");
}

void add_hold(CLI::App& root, HoldCommand& c) {
  CLI::App& pause = *root.add_subcommand("pause", "Hold a run that is not live");
  CLI::App& resume = *root.add_subcommand("resume", "Let a paused run go on");
  CLI::App& step = *root.add_subcommand("step", "Do steps of a paused run");
  for (CLI::App* const app : {&pause, &resume, &step}) {
    add_run_name(*app, c.run);
    add_network_options(*app, c.bus);
  }
  add_value(step, "--count", c.count, "How many [1]", "N")->check(CLI::Range(1, 1'000'000'000));
}

void add_end(CLI::App& root, EndCommand& c) {
  CLI::App& app = *root.add_subcommand("end", "End a run with all its processes");
  add_run_name(app, c.run);
  add_network_options(app, c.bus);
  app.footer(
      "The run ends before its next step and still writes its results. Its environment manager "
      "tells\n"
      "the hosts; where that is gone, the hosts themselves are asked: those that were forgotten "
      "wait\n"
      "for another one. `rave stop` is for robots: the run goes on.\n\n"
      "Examples:\n"
      "  rave end predator-prey\n"
      "  rave end 3f2a91c0 --interface 192.168.1.9 --peer 192.168.1.2");
}

void add_hand_over(CLI::App& root, HandOverCommand& c) {
  CLI::App& app = *root.add_subcommand("hand-over", "Give a robot its other drivers while it runs");
  add_word(app, "robot", c.robot, "One whose entry in the scenario has `twin:`", "ROBOT");
  add_word(app, "to", c.to, "real or simulated; or first (those of `file:`) or twin", "DRIVERS");
  add_value(app, "--run", c.run, "Name, process id or scenario of the run [the only one]", "RUN");
  add_network_options(app, c.bus);
  app.footer(
      "The drivers are opened, the robot is brought to stand, and between two steps it changes.\n"
      "Its program and its controllers go on. What keeps it from changing is told, and then\n"
      "everything is as it was.\n\n"
      "Examples:\n"
      "  rave hand-over create real\n"
      "  rave hand-over create simulated --run corridor");
}

void add_shadow(CLI::App& root, ShadowCommand& c) {
  CLI::App& app = *root.add_subcommand(
      "shadow", "How far real robots are from their simulated twins that run beside them");
  add_run_name(app, c.run);
  add_robot_name(app, c.robot);
  app.add_flag("--reset", c.reset, "Put the twin where the robot is");
  app.add_flag("--json", c.json, "Print the numbers as JSON");
  add_network_options(app, c.bus);
}

void add_order(CLI::App& app, OrderCommand& c) {
  add_value(app, "--run", c.run, "Name, process id or scenario of the run [the only one]", "RUN");
  app.add_flag("--force", c.force, "Take the robot from who drives it");
  add_network_options(app, c.bus);
}

void add_orders(CLI::App& root, ControlCommands& commands) {
  CLI::App& drive = *root.add_subcommand("drive", "Drive a robot of a run in place of its program");
  add_word(drive, "robot", commands.drive.robot, "Which one", "ROBOT");
  add_word(drive, "velocity", commands.drive.numbers, "Forward, m/s; to the left, rad/s", "V W")
      ->expected(2);
  add_value(drive, "--for", commands.drive.for_s, "So long, s [1]", "S")
      ->check(CLI::Range(0.1, 3600.0));
  add_order(drive, commands.drive);
  drive.footer(
      "The guard of the robot stays in force. When it ends, or this command is ended, the robot\n"
      "stands, and its program has it again.\n\n"
      "Examples:\n"
      "  rave drive prey 0.3 0.5 --for 2");
  CLI::App& goal = *root.add_subcommand("goal", "Send a robot of a run to a point or along a line");
  add_word(goal, "robot", commands.goal.robot, "Which one", "ROBOT");
  add_value(goal, "points", commands.goal.numbers, "World frame, m", "X Y [X Y ...]");
  add_value(goal, "--speed", commands.goal.speed_mps, "The largest, m/s [the robot's own]", "V");
  goal.add_flag("--cancel", commands.goal.cancel, "What was asked before counts no more");
  add_order(goal, commands.goal);
  goal.footer(
      "Examples:\n"
      "  rave goal prey 1.5 -2\n"
      "  rave goal prey 0 0 1 0 1 1 --speed 0.2\n"
      "  rave goal prey --cancel");
  CLI::App& say = *root.add_subcommand("say", "Tell the program of a robot something");
  add_word(say, "robot", commands.say.robot, "Which one", "ROBOT");
  add_word(say, "text", commands.say.text, "At most 1000 bytes", "TEXT");
  add_order(say, commands.say);
  CLI::App& place = *root.add_subcommand("place", "Put a simulated robot of a run elsewhere");
  add_word(place, "robot", commands.place.robot, "Which one", "ROBOT");
  add_word(place, "pose", commands.place.numbers, "World frame, m; degrees", "X Y [YAW]")
      ->expected(2, 3);
  add_order(place, commands.place);
  place.footer("Examples:\n  rave place prey 1.5 -2 90");
  commands.drive.what = OrderCommand::What::kDrive;
  commands.goal.what = OrderCommand::What::kGoal;
  commands.say.what = OrderCommand::What::kSay;
  commands.place.what = OrderCommand::What::kPlace;
}

void add_name(CLI::App& app, std::string& name) {
  add_word(app, "name", name, "Of the obstacle; `rave edit list` has them all", "NAME");
}

void add_place(CLI::App& app, std::string& at) {
  add_word(app, "--at", at, "X,Y or X,Y,DEG in metres and degrees; without DEG it is not turned",
           "PLACE");
}

void add_edit(CLI::App& root, EditCommand& c) {
  CLI::App& app =
      *root.add_subcommand("edit", "Add, move and remove obstacles of a run while it goes");
  add_run_name(app, c.run);
  app.require_subcommand(1);
  CLI::App& add = *app.add_subcommand("add", "Put an obstacle somewhere");
  add_word(add, "shape", c.shape, "box, disc or polygon", "SHAPE")
      ->check(CLI::IsMember({"box", "disc", "polygon"}));
  add_word(add, "--name", c.name, "What no other obstacle is called", "NAME");
  add_place(add, c.at);
  add_value(add, "--size", c.size, "LxW of a box, the radius of a disc, in metres", "SIZE");
  add_value(add, "--corners", c.corners, "Of a polygon, such as \"0,0 1,0 0.5,1\"", "PLACES");
  add_value(add, "--height", c.height, "LOW,HIGH above the floor [0,0.5]", "HEIGHT");
  add_value(add, "--layer", c.layer, "virtual_obstacles or mapped_real [virtual_obstacles]",
            "LAYER");
  add_value(add, "--colour", c.colour, "For pictures, #rrggbb", "COLOUR");
  add_value(add, "--barcode", c.barcode, "What landmark cameras read on it [none]", "N");
  CLI::App& move = *app.add_subcommand("move", "Put an obstacle elsewhere");
  add_name(move, c.name);
  add_place(move, c.at);
  CLI::App& remove = *app.add_subcommand("remove", "Take an obstacle away");
  add_name(remove, c.name);
  CLI::App& list = *app.add_subcommand("list", "Say which obstacles stand where");
  for (CLI::App* const each : {&add, &move, &remove, &list}) add_network_options(*each, c.bus);
  app.footer(
      "A change counts from the next step on; the answer says which that is. What would overlap a\n"
      "simulated robot is refused. A run that is not on this machine is looked for on the bus: "
      "give\n"
      "--interface and --peer as its processes have them. Exit code: 0 if it was done, 1 if the "
      "run\n"
      "refuses, 2 for bad input.\n\n"
      "Examples:\n"
      "  rave edit add box --name crate --at 1,2,30 --size 0.5x0.3\n"
      "  rave edit move crate --at 2,2\n"
      "  rave edit predator-prey remove crate\n"
      "  rave edit warehouse list --interface 192.168.1.9 --peer 192.168.1.2");
}

}  // namespace

void add_control_commands(CLI::App& root, ControlCommands& commands) {
  add_ps(root, commands.ps);
  add_stop(root, commands.stop);
  add_arm(root, commands.arm);
  add_set(root, commands.set);
  add_hold(root, commands.hold);
  add_end(root, commands.end);
  add_hand_over(root, commands.hand_over);
  add_shadow(root, commands.shadow);
  add_edit(root, commands.edit);
  add_orders(root, commands);
}

}  // namespace rave::cli
