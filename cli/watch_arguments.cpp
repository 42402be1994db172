// SPDX-License-Identifier: Apache-2.0
#include "commands/doctor.hpp"
#include "commands/map.hpp"
#include "commands/top.hpp"
#include "shared_arguments.hpp"

namespace rave::cli {
namespace {

void add_top(CLI::App& root, Command& chosen) {
  const auto [app, c] = add_command(root, chosen, "top",
                                    "Show live statistics of the hosts and robots of a run", top);
  add_value(app, "run", c.run,
            "Name of the run (--run), first digits of its number, or its scenario [the only run]",
            "RUN");
  app.add_flag("--once", c.once, "Print one table and exit");
  app.add_flag("--json", c.json, "Print one line of JSON per interval");
  app.add_flag("--robots", c.robots, "Also show each robot");
  add_value(app, "--interval", c.interval_s, "Seconds between updates [1; with --once 2.5]", "S")
      ->check(number_in(0.1, 3600.0));
  add_network_options(app, c.bus);
  app.footer(
      "It does not slow down the run. Keys on a terminal: q quits, r shows or hides the robots.\n"
      "Exit code: 0; 2 if there is no such run.\n\n"
      "Examples:\n"
      "  rave top\n"
      "  rave top flock --once\n"
      "  rave top --interface 192.168.1.7 --peer 192.168.1.2 --peer 192.168.1.7 --json");
}

constexpr char kWhichRun[] =
    "Name of the run (--run), first digits of its number, or its scenario [the only run]";

void add_maps(CLI::App& root, Command& chosen) {
  const auto [server, s] = add_command(
      root, chosen, "map-server", "Combine the maps of the robots of a run to one map", map_server);
  add_value(server, "run", s.run, kWhichRun, "RUN");
  add_network_options(server, s.bus);
  server.footer(
      "It asks each robot of a run of several processes for its map, and publishes one global map "
      "per team, until the run ends. A run in one process needs none: its page has the global "
      "map.\n"
      "Exit code: 0; 2 if there is no such run.\n\n"
      "Examples:\n"
      "  rave map-server\n"
      "  rave map-server collaborative-mapping");
  CLI::App& parent = *root.add_subcommand("map", "Maps that robots make during a run");
  parent.require_subcommand(1);
  const auto [save, c] = add_command(parent, chosen, "save",
                                     "Write a map as PGM and YAML for ROS map_server", map_save);
  add_value(save, "run", c.run, kWhichRun, "RUN");
  add_value(save, "--map", c.map, "Name of a robot, or of a global map [global]", "NAME");
  add_value(save, "--output,-o", c.file, "Name of both files without ending [that of the map]",
            "FILE");
  add_network_options(save, c.bus);
  save.footer(
      "For a run of several processes. Each run leaves the maps of its programs in the folder "
      "`maps` of its results, too.\n"
      "Exit code: 0; 2 if there is no such run or map.\n\n"
      "Examples:\n"
      "  rave map save\n"
      "  rave map save --map patton -o patton");
}

void add_doctor(CLI::App& root, Command& chosen) {
  const auto [app, c] = add_command(root, chosen, "doctor",
                                    "Find out why two machines do not find each other", doctor);
  add_network_options(app, c.bus);
  app.add_flag("--listen", c.listen, "Answer `rave doctor` of another machine, until Ctrl-C");
  app.add_flag("--json", c.json, "Print the findings as JSON");
  app.footer(
      "Checks this machine, and the connection to each --peer on which `rave doctor --listen` "
      "runs.\n"
      "Exit code: 0 if no problem was found, 1 if there are problems, 2 for bad input.\n\n"
      "Examples:\n"
      "  rave doctor --listen --interface 192.168.1.2       # on the one machine\n"
      "  rave doctor --interface 192.168.1.7 --peer 192.168.1.2");
}

}  // namespace

void add_watch_commands(CLI::App& root, Command& chosen) {
  add_top(root, chosen);
  add_maps(root, chosen);
  add_doctor(root, chosen);
}

}  // namespace rave::cli
