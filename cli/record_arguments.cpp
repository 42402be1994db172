// SPDX-License-Identifier: Apache-2.0
#include "record_arguments.hpp"

#include "bus_arguments.hpp"
#include "run_arguments.hpp"
#include "shared_arguments.hpp"

namespace rave::cli {
namespace {

void add_info(CLI::App& root, InfoCommand& c) {
  CLI::App& app = *root.add_subcommand("info", "Say what is in the record of a run");
  add_record(app, c.file);
  app.add_flag(
      "--check", c.check,
      "Read all of it and compare every checksum; without it only index, beginning and end");
  app.add_flag("--json", c.json, "For other programs");
  app.footer(
      "Exit code: 0, 1 if something is wrong with the record, 2 if it is none.\n\n"
      "Examples:\n"
      "  rave info runs/20260101-120000-mixed-reality\n"
      "  rave info runs/20260101-120000-mixed-reality --check");
}

void add_verify(CLI::App& root, VerifyCommand& c) {
  CLI::App& app =
      *root.add_subcommand("verify", "Run what a record holds again and compare it to the bit");
  add_record(app, c.file);
  add_threads(app, c.threads);
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
  add_record(app, c.file);
  add_values(app, "--robot", c.robots, "One of the recorded robots; may be repeated [all]", "NAME");
  add_values(app, "--anew", c.anew,
             "A virtual sensor that senses the new world instead of being played; may be "
             "repeated",
             "SENSOR");
  add_value(app, "--world", c.world, "A world file [the world of the record]", "FILE");
  add_value(app, "--program", c.program,
            "Program that gets the readings; its commands are ignored [none]", "NAME");
  add_value(app, "--start", c.start_s, "Time of the record to start at, in seconds [0]", "S")
      ->check(CLI::Range(0.0, 1e9));
  add_value(app, "--write", c.write, "Only write the scenario, into this folder", "DIR");
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
  add_record(app, c.file);
  add_value(app, "--robot", c.robot, "The recorded robot [the only one]", "NAME");
  add_value(app, "--twin", c.twin, "Robot file whose simulated actuator drives the twin [its own]",
            "FILE");
  add_value(app, "--commands", c.commands,
            "Velocity sensor that tells the commands [what reached the actuator]", "SENSOR");
  app.add_flag("--truth", c.truth, "Compare with the true pose, not with the reported one");
  add_value(app, "--window", c.window_s, "Length of the windows that start anew, in seconds [10]",
            "S")
      ->check(CLI::Range(1e-3, 1e6));
  add_value(app, "--output", c.output, "Folder for picture and numbers [that of the record]",
            "DIR");
  app.add_flag("--json", c.json, "Print the numbers as JSON");
  add_plugins(app, c.plugins);
  app.footer(
      "The twin starts where the robot was first known to be and drives in an empty world.\n\n"
      "Examples:\n"
      "  rave report gap runs/20260101-120000-corridor --robot create --twin robots/twin.yaml\n"
      "  rave report gap run.mcap --robot real-3 --commands commanded --twin robots/wanderer.yaml");
}

void add_gui(CLI::App& root, GuiCommand& c) {
  CLI::App& app = *root.add_subcommand("gui", "Show a run or a recording in the browser");
  add_word(app, "what", c.file, "A recording, the folder of a run, or the scenario of a run",
           "WHAT");
  add_page_options(app, c.page);
  add_processes(app, c.run.processes, "As of `rave env`", 2);
  add_plugins(app, c.run.plugins);
  add_bus_options(app, c.run.bus);
  app.footer(
      "Of a scenario, the run of several processes is shown that goes on, or will; it is found on\n"
      "the bus as its processes are. `rave run --gui` shows a run of one process.\n\n"
      "Examples:\n"
      "  rave gui runs/20260101-120000-mixed-reality\n"
      "  rave gui lab --interface 192.168.1.7 --peer 192.168.1.2");
}

}  // namespace

void add_record_commands(CLI::App& root, RecordCommands& commands) {
  add_info(root, commands.info);
  add_verify(root, commands.verify);
  add_play(root, commands.play);
  add_report(root, commands.gap);
  add_gui(root, commands.gui);
}

}  // namespace rave::cli
