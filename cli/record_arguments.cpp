// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "commands/export.hpp"
#include "commands/gui.hpp"
#include "commands/info.hpp"
#include "commands/play.hpp"
#include "commands/report.hpp"
#include "commands/verify.hpp"
#include "shared_arguments.hpp"

namespace rave::cli {
namespace {

void add_info(CLI::App& root, Command& chosen) {
  const auto [app, c] = add_command(root, chosen, "info", "Show the contents of a recording", info);
  add_record(app, c.file);
  app.add_flag("--check", c.check,
               "Read the complete file and verify every checksum [only index, start and end]");
  app.add_flag("--json", c.json, "Print JSON");
  app.footer(
      "Exit code: 0 if the recording is good, 1 if it is damaged or incomplete, 2 if it is not a\n"
      "recording.\n\n"
      "Examples:\n"
      "  rave info runs/20260101-120000-mixed-reality\n"
      "  rave info runs/20260101-120000-mixed-reality --check");
}

void add_verify(CLI::App& root, Command& chosen) {
  const auto [app, c] =
      add_command(root, chosen, "verify", "Run a recording again and compare every bit", verify);
  add_record(app, c.file);
  add_threads(app, c.threads);
  app.add_flag("--quiet", c.quiet, "Print errors and differences only");
  add_plugins(app, c.plugins);
  app.footer(
      "Maps are taken from the recording. Exit code: 0 if every step is equal; 1 if not, with the\n"
      "first step, robot and channel that differ, or if the recording is incomplete, with the "
      "time\n"
      "to which it is equal; 2 if the run cannot be repeated (a live run, or missing input "
      "files).\n\n"
      "Example:\n"
      "  rave verify runs/20260101-120000-mixed-reality");
}

void add_play(CLI::App& root, Command& chosen) {
  const auto [app, c] =
      add_command(root, chosen, "play",
                  "Use robots of a recording as recorded real robots in a new scenario", play);
  add_record(app, c.file);
  add_values(app, "--robot", c.how.robots, "Robot of the recording; repeatable [all]", "NAME");
  add_values(app, "--anew", c.how.anew,
             "Virtual sensor that senses the new world instead of being played; repeatable",
             "SENSOR");
  add_value(app, "--world", c.how.world, "World file [world of the recording]", "FILE");
  add_value(app, "--program", c.how.program,
            "Program that receives the readings; its commands are ignored [none]", "NAME");
  add_value(app, "--start", c.how.start_s, "Start time in the recording, in seconds [0]", "S")
      ->check(number_in(0.0, 1e9));
  add_value(app, "--write", c.write, "Write the scenario to this folder, and do not run it", "DIR");
  add_run_options(app, c.run);
  app.footer(
      "The scenario is written to the folder `played` of the run. You can add simulated robots to\n"
      "it. Exit code: as for `rave run`.\n\n"
      "Examples:\n"
      "  rave play runs/20260101-120000-mixed-reality --robot walker-3 --anew laser\n"
      "  rave play run.mcap --robot hunter --program wander --write my/scenario");
}

void add_export(CLI::App& root, Command& chosen) {
  const auto [app, c] =
      add_command(root, chosen, "export", "Write a part of a recording as CSV", export_recording);
  add_record(app, c.file);
  add_word(app, "what", c.what, "poses, readings or events", "WHAT")
      ->check(one_of({"poses", "readings", "events"}));
  add_value(app, "--robot", c.robot, "Only this robot [all]; required for readings", "NAME");
  add_value(app, "--sensor", c.sensor, "Sensor, for readings", "NAME");
  add_value(app, "--output", c.output, "File to write [standard output]", "FILE");
  app.footer(
      "Times are seconds of the run, all other values SI units. A range without return is `inf`.\n"
      "Columns: docs/how-to/read-a-recording.md of the documentation (share/doc/rave). Exit code: "
      "0, or 2 for bad input.\n\n"
      "Examples:\n"
      "  rave export runs/20260101-120000-mixed-reality poses > poses.csv\n"
      "  rave export run.mcap readings --robot hunter --sensor laser --output laser.csv");
}

void add_report(CLI::App& root, Command& chosen) {
  CLI::App& parent =
      *root.add_subcommand("report", "Report what an experiment shows, or analyse a recording");
  const auto options = std::make_shared<ReportCommand>();
  ReportCommand& e = *options;
  parent.require_subcommand(0, 1);
  // The command below it is the one that was meant.
  parent.callback([&chosen, app = &parent, options] {
    if (app->get_subcommands().empty()) chosen = [options] { return report_experiment(*options); };
  });
  add_value(parent, "folder", e.folder, "Folder of a sweep", "FOLDER");
  add_value(parent, "--output", e.output, "Folder for report.html and conditions.csv [FOLDER]",
            "DIR");
  parent.add_flag("--quiet", e.quiet, "Print errors only");
  parent.footer(
      "The page has the question, the answer and the evidence, and asks for nothing else. Exit\n"
      "code: 0, 1 if the runs do not show what the experiment file expects, 2 for bad input.\n\n"
      "Examples:\n"
      "  rave report sweeps/prey-speed\n"
      "  rave report gap run.mcap --robot walker-3");
  const auto [app, c] = add_command(
      parent, chosen, "gap",
      "Compare a recorded robot with its simulated twin under the same commands", report_gap);
  add_record(app, c.file);
  add_value(app, "--robot", c.gap.robot, "Recorded robot [the only one]", "NAME");
  add_value(app, "--twin", c.gap.twin,
            "Robot file with the simulated actuator of the twin [that of the robot]", "FILE");
  add_value(app, "--commands", c.gap.commands,
            "Velocity sensor to use as commands [what reached the actuator]", "SENSOR");
  app.add_flag("--truth", c.gap.truth, "Compare with the true pose instead of the reported pose");
  add_value(app, "--window", c.gap.window_s,
            "Time after which the twin is set to the robot again, in seconds [10]", "S")
      ->check(number_in(1e-3, 1e6));
  add_value(app, "--output", c.output,
            "Folder for the picture and the numbers [that of the recording]", "DIR");
  app.add_flag("--json", c.json, "Print the numbers as JSON");
  add_plugins(app, c.plugins);
  app.footer(
      "The twin starts at the first known pose of the robot and drives in an empty world.\n\n"
      "Examples:\n"
      "  rave report gap runs/20260101-120000-corridor --robot create --twin robots/twin.yaml\n"
      "  rave report gap run.mcap --robot real-3 --commands commanded --twin robots/wanderer.yaml");
}

void add_gui(CLI::App& root, Command& chosen) {
  const auto [app, c] =
      add_command(root, chosen, "gui", "Show a run or a recording in the browser", gui);
  add_value(
      app, "what", c.file,
      "Recording, folder of a run, or scenario of a run in progress [a page that starts runs]",
      "WHAT");
  add_page_options(app, c.page);
  add_processes(app, c.run.processes, "Number of hosts among which the robots are divided", 2);
  add_plugins(app, c.run.plugins);
  add_bus_options(app, c.run.bus);
  app.footer(
      "With a scenario, shows its run of several processes, found on the bus, even if it starts\n"
      "later. For a run of one process use `rave run --gui`.\n"
      "Without an argument, the page lists scenarios and recordings, and who may do so starts, "
      "ends\n"
      "and restarts runs there, one at a time; their results are below `runs`.\n\n"
      "Examples:\n"
      "  rave gui\n"
      "  rave gui runs/20260101-120000-mixed-reality\n"
      "  rave gui lab --interface 192.168.1.7 --peer 192.168.1.2");
}

}  // namespace

void add_record_commands(CLI::App& root, Command& chosen) {
  add_info(root, chosen);
  add_verify(root, chosen);
  add_play(root, chosen);
  add_export(root, chosen);
  add_report(root, chosen);
  add_gui(root, chosen);
}

}  // namespace rave::cli
