// SPDX-License-Identifier: Apache-2.0
#include "control_arguments.hpp"

#include "bus_arguments.hpp"
#include "shared_arguments.hpp"

namespace rave::cli {
namespace {

void add_run_name(CLI::App& app, std::string& run) {
  add_value(app, "run", run, "Name, process id or scenario of the run, or RUN@HOST [the only run]",
            "RUN");
}

/// For commands whose first argument is a robot.
void add_run_option(CLI::App& app, std::string& run) {
  add_value(app, "--run", run,
            "Name, process id or scenario of the run, or RUN@HOST [the only run]", "RUN");
}

void add_robot_name(CLI::App& app, std::string& robot) {
  add_value(app, "--robot", robot, "Only this robot [all]", "NAME");
}

void add_ps(CLI::App& root, PsCommand& c) {
  CLI::App& app = *root.add_subcommand("ps", "List runs in progress");
  app.add_flag("--robots", c.robots, "Also list each robot, and whether it may move");
  app.add_flag("--network", c.network,
               "Also list runs of several processes found on the bus, including other machines; "
               "implied by the options below");
  add_network_options(app, c.bus);
  app.footer(
      "The search on the bus takes 1.5 s, or 3 s with other machines. A run is listed there by "
      "the\n"
      "first digits of its number. A run of this machine that is on the bus is listed twice.\n\n"
      "Examples:\n"
      "  rave ps\n"
      "  rave ps --interface 192.168.1.9 --peer 192.168.1.2");
}

void add_stop(CLI::App& root, StopCommand& c) {
  CLI::App& app = *root.add_subcommand("stop", "Stop robots of a run until they are released");
  add_run_name(app, c.run);
  add_robot_name(app, c.robot);
  app.add_flag("--all", c.all, "Stop every robot of every run on this machine");
  add_network_options(app, c.bus);
  app.footer(
      "No program can move a stopped robot. `rave arm --release` releases it.\n\n"
      "Examples:\n"
      "  rave stop\n"
      "  rave stop predator-prey --robot predator");
}

void add_arm(CLI::App& root, ArmCommand& c) {
  CLI::App& app = *root.add_subcommand("arm", "Permit real robots of a run to move");
  add_run_name(app, c.run);
  add_robot_name(app, c.robot);
  app.add_flag("--release", c.release, "Also release stopped robots");
  add_network_options(app, c.bus);
}

void add_set(CLI::App& root, SetCommand& c) {
  CLI::App& app = *root.add_subcommand("set", "Change a parameter of a robot during a run");
  add_word(app, "robot", c.robot, "Name of the robot", "ROBOT");
  add_word(app, "key", c.key,
           "Parameter: program.PARAM, controller.NAME.PARAM, actuator.NAME.PARAM or body.scale",
           "KEY");
  add_word(app, "value", c.value, "Its new value", "VALUE");
  add_run_option(app, c.run);
  add_network_options(app, c.bus);
  app.footer(
      "Examples:\n"
      "  rave set prey program.max_speed_mps 0.6\n"
      "  rave set prey body.scale 1.5 --run predator-prey");
}

void add_hold(CLI::App& root, HoldCommand& c) {
  CLI::App& pause = *root.add_subcommand("pause", "Pause a run (not a live one)");
  CLI::App& resume = *root.add_subcommand("resume", "Continue a paused run");
  CLI::App& step = *root.add_subcommand("step", "Compute single steps of a paused run");
  for (CLI::App* const app : {&pause, &resume, &step}) {
    add_run_name(*app, c.run);
    add_network_options(*app, c.bus);
  }
  add_value(step, "--count", c.count, "Number of steps [1]", "N")
      ->check(whole_number_in(1, 1'000'000'000));
}

void add_end(CLI::App& root, EndCommand& c) {
  CLI::App& app = *root.add_subcommand("end", "End a run and all of its processes");
  add_run_name(app, c.run);
  add_network_options(app, c.bus);
  app.footer(
      "The run ends before its next step and writes its results. The environment manager ends the\n"
      "hosts. If the manager is gone, the waiting hosts are asked directly. To stop robots "
      "without\n"
      "ending the run, use `rave stop`.\n\n"
      "Examples:\n"
      "  rave end predator-prey\n"
      "  rave end 3f2a91c0 --interface 192.168.1.9 --peer 192.168.1.2");
}

void add_hand_over(CLI::App& root, HandOverCommand& c) {
  CLI::App& app = *root.add_subcommand(
      "hand-over", "Switch a robot between real and simulated drivers during a run");
  add_word(app, "robot", c.robot, "Robot whose entry in the scenario has `twin:`", "ROBOT");
  add_word(app, "to", c.to, "real or simulated; or first (drivers of `file:`) or twin", "DRIVERS");
  add_run_option(app, c.run);
  add_network_options(app, c.bus);
  app.footer(
      "The new drivers are opened, the robot is stopped, and it changes between two steps. Its\n"
      "program and controllers continue. If it cannot change, the reason is printed and nothing\n"
      "changes.\n\n"
      "Examples:\n"
      "  rave hand-over create real\n"
      "  rave hand-over create simulated --run corridor");
}

void add_shadow(CLI::App& root, ShadowCommand& c) {
  CLI::App& app = *root.add_subcommand(
      "shadow", "Show the distance between real robots and their simulated twins (shadows)");
  add_run_name(app, c.run);
  add_robot_name(app, c.robot);
  app.add_flag("--reset", c.reset, "Move the twin to the pose of the robot");
  app.add_flag("--json", c.json, "Print the numbers as JSON");
  add_network_options(app, c.bus);
}

void add_order(CLI::App& app, OrderCommand& c) {
  add_run_option(app, c.run);
  app.add_flag("--force", c.force, "Take the robot from the person who drives it");
  add_network_options(app, c.bus);
}

void add_orders(CLI::App& root, ControlCommands& commands) {
  CLI::App& drive = *root.add_subcommand("drive", "Drive a robot of a run instead of its program");
  add_word(drive, "robot", commands.drive.robot, "Name of the robot", "ROBOT");
  add_word(drive, "velocity", commands.drive.numbers,
           "Speed forward in m/s, and turning rate to the left in rad/s", "V W")
      ->expected(2);
  add_value(drive, "--for", commands.drive.for_s, "Duration in seconds [1]", "S")
      ->check(number_in(0.1, 3600.0));
  add_order(drive, commands.drive);
  drive.footer(
      "The guard of the robot stays active. After the duration, or when this command is ended, "
      "the\n"
      "robot stops, and its program drives it again.\n\n"
      "Examples:\n"
      "  rave drive prey 0.3 0.5 --for 2");
  CLI::App& goal = *root.add_subcommand("goal", "Send a robot of a run to a point or along a line");
  add_word(goal, "robot", commands.goal.robot, "Name of the robot", "ROBOT");
  add_value(goal, "points", commands.goal.numbers, "Points in the world frame, in metres",
            "X Y [X Y ...]");
  add_value(goal, "--speed", commands.goal.speed_mps, "Largest speed in m/s [that of the robot]",
            "V");
  goal.add_flag("--cancel", commands.goal.cancel, "Cancel the current order");
  add_order(goal, commands.goal);
  goal.footer(
      "Examples:\n"
      "  rave goal prey 1.5 -2\n"
      "  rave goal prey 0 0 1 0 1 1 --speed 0.2\n"
      "  rave goal prey --cancel");
  CLI::App& say = *root.add_subcommand("say", "Send a text to the program of a robot");
  add_word(say, "robot", commands.say.robot, "Name of the robot", "ROBOT");
  add_word(say, "text", commands.say.text, "Text, at most 1000 bytes", "TEXT");
  add_order(say, commands.say);
  CLI::App& place = *root.add_subcommand("place", "Move a simulated robot of a run to a pose");
  add_word(place, "robot", commands.place.robot, "Name of the robot", "ROBOT");
  add_word(place, "pose", commands.place.numbers, "Pose in the world frame, in metres and degrees",
           "X Y [YAW]")
      // The heading may be left out; the robot then keeps the one that it has.
      ->expected(2, 3);
  add_order(place, commands.place);
  place.footer("Examples:\n  rave place prey 1.5 -2 90");
  // Four commands share one structure, and this says which of them was given.
  commands.drive.what = OrderCommand::What::kDrive;
  commands.goal.what = OrderCommand::What::kGoal;
  commands.say.what = OrderCommand::What::kSay;
  commands.place.what = OrderCommand::What::kPlace;
}

void add_name(CLI::App& app, std::string& name) {
  add_word(app, "name", name, "Name of the obstacle; `rave edit list` lists all", "NAME");
}

void add_place(CLI::App& app, std::string& at) {
  add_word(app, "--at", at, "X,Y or X,Y,DEG, in metres and degrees; DEG is 0 if left out", "PLACE");
}

void add_edit(CLI::App& root, EditCommand& c) {
  CLI::App& app = *root.add_subcommand("edit", "Add, move and remove obstacles during a run");
  add_run_name(app, c.run);
  // The name of the run is an argument of `edit` itself, so it stands before the subcommand.
  app.require_subcommand(1);
  CLI::App& add = *app.add_subcommand("add", "Add an obstacle");
  add_word(add, "shape", c.shape, "box, disc or polygon", "SHAPE")
      ->check(one_of({"box", "disc", "polygon"}));
  add_word(add, "--name", c.name, "Name of the obstacle, unique in the run", "NAME");
  add_place(add, c.at);
  add_value(add, "--size", c.size, "Length x width of a box (LxW), or radius of a disc, in metres",
            "SIZE");
  add_value(add, "--corners", c.corners, "Corners of a polygon, such as \"0,0 1,0 0.5,1\"",
            "PLACES");
  add_value(add, "--height", c.height,
            "Lower and upper edge above the floor, LOW,HIGH in metres [0,0.5]", "HEIGHT");
  add_value(add, "--layer", c.layer, "virtual_obstacles or mapped_real [virtual_obstacles]",
            "LAYER")
      ->check(CLI::IsMember({"virtual_obstacles", "mapped_real"}).description(""));
  add_value(add, "--colour", c.colour, "Colour in pictures, #rrggbb", "COLOUR");
  add_value(add, "--barcode", c.barcode, "Barcode that landmark cameras read [none]", "N");
  CLI::App& move = *app.add_subcommand("move", "Move an obstacle");
  add_name(move, c.name);
  add_place(move, c.at);
  CLI::App& remove = *app.add_subcommand("remove", "Remove an obstacle");
  add_name(remove, c.name);
  CLI::App& list = *app.add_subcommand("list", "List the obstacles and their poses");
  for (CLI::App* const each : {&add, &move, &remove, &list}) add_network_options(*each, c.bus);
  app.footer(
      "A change takes effect in the next step; the answer names that step. An obstacle that would\n"
      "overlap a simulated robot is refused. For a run on other machines, give --interface and\n"
      "--peer as for its processes. Exit code: 0 if the change was made, 1 if the run refused it,\n"
      "2 for bad input.\n\n"
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
