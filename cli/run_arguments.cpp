// SPDX-License-Identifier: Apache-2.0
#include "run_arguments.hpp"

#include "bus_arguments.hpp"
#include "shared_arguments.hpp"

namespace rave::cli {
namespace {

void add_run(CLI::App& root, RunCommand& c) {
  CLI::App& app = *root.add_subcommand("run", "Run a scenario");
  add_scenario(app, c.scenario);
  add_run_options(app, c);
  add_processes(app, c.processes, "Share the robots evenly among so many processes", 1);
  app.add_flag("--gui", c.gui,
               "Show the run in the browser, in real time unless --pace says otherwise; then its "
               "recording, until Ctrl-C");
  add_page_options(app, c.page);
  add_line_options(app, c.line);
  add_bus_options(app, c.bus);
  app.footer(
      "Exit code: 0 if the run was whole and its checks hold, 1 if not, 2 for bad input.\n"
      "Ctrl-C ends a run early and still writes its results; a second one kills it.\n"
      "`rave stop`, `arm`, `set`, `edit`, `pause` and `ps` work from another terminal.\n\n"
      "Examples:\n"
      "  rave run mixed-reality --pace 10x\n"
      "  rave run my/scenario.yaml --seed 7 --duration 30 --output results");
}

void add_robot(CLI::App& root, RobotCommand& c) {
  CLI::App& app = *root.add_subcommand("robot", "Run the robots of one host of a scenario");
  add_scenario(app, c.run.scenario);
  add_word(app, "--host", c.host, "Which one, as the scenario names it", "NAME");
  add_value(app, "--wait-for-manager", c.manager_patience_s,
            "Give up after so many seconds without an environment manager [never]", "S")
      ->check(CLI::Range(0.1, 1e9));
  add_run_options(app, c.run);
  add_processes(app, c.run.processes, "As of `rave env`", 2);
  add_line_options(app, c.run.line);
  add_bus_options(app, c.run.bus);
  app.footer(
      "It waits for the environment manager of the run (`rave env`, or `rave run` of the same\n"
      "scenario), however late that comes, and goes on with the next one if it is lost; in real\n"
      "time also without one.\n"
      "Exit code: 0 if it took part from the first step to the last, 1 if not, 2 for bad input.\n\n"
      "Examples:\n"
      "  rave robot lab --host left\n"
      "  rave robot lab --host left --interface 192.168.1.7 --peer 192.168.1.2");
}

void add_env(CLI::App& root, EnvCommand& c) {
  CLI::App& app =
      *root.add_subcommand("env", "Manage the world of a scenario that several hosts share");
  add_scenario(app, c.run.scenario);
  app.add_flag("--resume", c.resume,
               "Go on with a run that has lost its manager; on_lost_host: restart does it anyway");
  add_run_options(app, c.run);
  add_processes(app, c.run.processes, "Share the robots evenly among host-1, host-2 ...", 2);
  add_bus_options(app, c.run.bus);
  app.footer(
      "The hosts are started with `rave robot`, in any order. If it dies, another one goes on in\n"
      "its place with --resume; without it, hosts of a run that has begun are left alone, and\n"
      "`rave end` ends them. Exit code: 0 if the run was whole, 1 if not, 2 for bad input.\n\n"
      "Examples:\n"
      "  rave env lab\n"
      "  rave env lab --resume");
}

}  // namespace

void add_run_options(CLI::App& app, RunCommand& c) {
  add_value(app, "--output", c.output, "Folder for what the run leaves [runs/<time>-<scenario>]",
            "DIR");
  app.add_flag("--replace", c.replace, "Remove what an earlier run left in that folder");
  add_value(app, "--seed", c.seed, "Another seed of all chance", "N");
  add_threads(app, c.threads);
  add_value(app, "--duration", c.duration_s, "Simulated time in seconds", "S")
      ->check(CLI::Range(1e-4, 1e9));
  add_value(app, "--pace", c.pace, "max, realtime, or a factor such as 10x", "PACE");
  app.add_flag("--no-picture", c.no_picture, "Do not draw picture.svg and picture.png");
  app.add_flag("--no-record", c.no_record, "Do not write run.mcap");
  app.add_flag("--arm", c.arm, "Arm all robots at the start: real ones may drive at once");
  app.add_flag("--quiet", c.quiet, "Print errors and problems only");
  add_plugins(app, c.plugins);
}

void add_run_commands(CLI::App& root, RunCommands& commands) {
  add_run(root, commands.run);
  add_robot(root, commands.robot);
  add_env(root, commands.env);
}

}  // namespace rave::cli
