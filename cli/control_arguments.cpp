// SPDX-License-Identifier: Apache-2.0
#include "commands/control.hpp"
#include "commands/edit.hpp"
#include "commands/end.hpp"
#include "commands/hand_over.hpp"
#include "commands/order.hpp"
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

void add_ps(CLI::App& root, Command& chosen) {
  const auto [app, c] = add_command(root, chosen, "ps", "List runs in progress", list_runs);
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

void add_stop(CLI::App& root, Command& chosen) {
  const auto [app, c] = add_command(root, chosen, "stop",
                                    "Stop robots of a run until they are released", stop_robots);
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

void add_arm(CLI::App& root, Command& chosen) {
  const auto [app, c] =
      add_command(root, chosen, "arm", "Permit real robots of a run to move", arm_robots);
  add_run_name(app, c.run);
  add_robot_name(app, c.robot);
  app.add_flag("--release", c.release, "Also release stopped robots");
  add_network_options(app, c.bus);
}

void add_set(CLI::App& root, Command& chosen) {
  const auto [app, c] =
      add_command(root, chosen, "set", "Change a parameter of a robot during a run", set_parameter);
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

Subcommand<HoldCommand> add_hold(CLI::App& root, Command& chosen, const char* name,
                                 const char* what, const control::ProcessAction& request) {
  const auto hold = add_command(root, chosen, name, what, hold_run);
  hold.options.what = request;
  add_run_name(hold.app, hold.options.run);
  add_network_options(hold.app, hold.options.bus);
  return hold;
}

void add_holds(CLI::App& root, Command& chosen) {
  add_hold(root, chosen, "pause", "Pause a run (not a live one)", control::Pause());
  add_hold(root, chosen, "resume", "Continue a paused run", control::Resume());
  const auto [step, c] =
      add_hold(root, chosen, "step", "Compute single steps of a paused run", control::Step());
  add_value(step, "--count", c.count, "Number of steps [1]", "N")
      ->check(whole_number_in(1, 1'000'000'000));
}

void add_end(CLI::App& root, Command& chosen) {
  const auto [app, c] =
      add_command(root, chosen, "end", "End a run and all of its processes", end_run);
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

void add_hand_over(CLI::App& root, Command& chosen) {
  const auto [app, c] =
      add_command(root, chosen, "hand-over",
                  "Switch a robot between real and simulated drivers during a run", hand_over);
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

void add_shadow(CLI::App& root, Command& chosen) {
  const auto [app, c] = add_command(
      root, chosen, "shadow",
      "Show the distance between real robots and their simulated twins (shadows)", show_shadows);
  add_run_name(app, c.run);
  add_robot_name(app, c.robot);
  app.add_flag("--reset", c.reset, "Move the twin to the pose of the robot");
  app.add_flag("--json", c.json, "Print the numbers as JSON");
  add_network_options(app, c.bus);
}

/// The beginning of a command for one robot.
Subcommand<OrderCommand> add_order(CLI::App& root, Command& chosen, const char* name,
                                   const char* what, OrderCommand::What order) {
  const auto added = add_command(root, chosen, name, what, give_order);
  added.options.what = order;
  add_word(added.app, "robot", added.options.robot, "Name of the robot", "ROBOT");
  return added;
}

/// The last options of such a command.
void add_order_options(CLI::App& app, OrderCommand& c) {
  add_run_option(app, c.run);
  app.add_flag("--force", c.force, "Take the robot from the person who drives it");
  add_network_options(app, c.bus);
}

void add_drive(CLI::App& root, Command& chosen) {
  const auto [app, c] =
      add_order(root, chosen, "drive", "Drive a robot of a run instead of its program",
                OrderCommand::What::kDrive);
  add_word(app, "velocity", c.numbers,
           "Speed forward in m/s, and turning rate to the left in rad/s", "V W")
      ->expected(2);
  add_value(app, "--for", c.for_s, "Duration in seconds [1]", "S")->check(number_in(0.1, 3600.0));
  add_order_options(app, c);
  app.footer(
      "The guard of the robot stays active. After the duration, or when this command is ended, "
      "the\n"
      "robot stops, and its program drives it again.\n\n"
      "Examples:\n"
      "  rave drive prey 0.3 0.5 --for 2");
}

void add_goal(CLI::App& root, Command& chosen) {
  const auto [app, c] =
      add_order(root, chosen, "goal", "Send a robot of a run to a point or along a line",
                OrderCommand::What::kGoal);
  add_value(app, "points", c.numbers, "Points in the world frame, in metres", "X Y [X Y ...]");
  add_value(app, "--speed", c.speed_mps, "Largest speed in m/s [that of the robot]", "V");
  app.add_flag("--cancel", c.cancel, "Cancel the current order");
  add_order_options(app, c);
  app.footer(
      "Examples:\n"
      "  rave goal prey 1.5 -2\n"
      "  rave goal prey 0 0 1 0 1 1 --speed 0.2\n"
      "  rave goal prey --cancel");
}

void add_say(CLI::App& root, Command& chosen) {
  const auto [app, c] = add_order(root, chosen, "say", "Send a text to the program of a robot",
                                  OrderCommand::What::kSay);
  add_word(app, "text", c.text, "Text, at most 1000 bytes", "TEXT");
  add_order_options(app, c);
}

void add_place(CLI::App& root, Command& chosen) {
  const auto [app, c] =
      add_order(root, chosen, "place", "Move a simulated robot of a run to a pose",
                OrderCommand::What::kPlace);
  add_word(app, "pose", c.numbers, "Pose in the world frame, in metres and degrees", "X Y [YAW]")
      // The heading may be left out; the robot then keeps the one that it has.
      ->expected(2, 3);
  add_order_options(app, c);
  app.footer("Examples:\n  rave place prey 1.5 -2 90");
}

CLI::App& add_change(const Subcommand<EditCommand>& edit, EditCommand::What change,
                     const char* name, const char* what) {
  CLI::App& app = *edit.app.add_subcommand(name, what);
  app.callback([&c = edit.options, change] { c.what = change; });
  return app;
}

void add_name(CLI::App& app, std::string& name) {
  add_word(app, "name", name, "Name of the obstacle; `rave edit list` lists all", "NAME");
}

void add_at(CLI::App& app, std::string& at) {
  add_word(app, "--at", at, "X,Y or X,Y,DEG, in metres and degrees; DEG is 0 if left out", "PLACE");
}

void add_edit(CLI::App& root, Command& chosen) {
  using What = EditCommand::What;
  const auto edit =
      add_command(root, chosen, "edit", "Add, move and remove obstacles during a run", edit_world);
  const auto& [app, c] = edit;
  add_run_name(app, c.run);
  // The name of the run is an argument of `edit` itself, so it stands before the subcommand.
  app.require_subcommand(1);
  CLI::App& add = add_change(edit, What::kAdd, "add", "Add an obstacle");
  add_word(add, "shape", c.shape, "box, disc or polygon", "SHAPE")
      ->check(one_of({"box", "disc", "polygon"}));
  add_word(add, "--name", c.name, "Name of the obstacle, unique in the run", "NAME");
  add_at(add, c.at);
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
  CLI::App& move = add_change(edit, What::kMove, "move", "Move an obstacle");
  add_name(move, c.name);
  add_at(move, c.at);
  CLI::App& remove = add_change(edit, What::kRemove, "remove", "Remove an obstacle");
  add_name(remove, c.name);
  CLI::App& list = add_change(edit, What::kList, "list", "List the obstacles and their poses");
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

void add_control_commands(CLI::App& root, Command& chosen) {
  add_ps(root, chosen);
  add_stop(root, chosen);
  add_arm(root, chosen);
  add_set(root, chosen);
  add_holds(root, chosen);
  add_end(root, chosen);
  add_hand_over(root, chosen);
  add_shadow(root, chosen);
  add_edit(root, chosen);
  add_drive(root, chosen);
  add_goal(root, chosen);
  add_say(root, chosen);
  add_place(root, chosen);
}

}  // namespace rave::cli
