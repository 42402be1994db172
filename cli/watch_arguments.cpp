// SPDX-License-Identifier: Apache-2.0
#include "watch_arguments.hpp"

#include "bus_arguments.hpp"
#include "shared_arguments.hpp"

namespace rave::cli {

void add_top(CLI::App& root, TopCommand& c) {
  CLI::App& app = *root.add_subcommand("top", "Show how the hosts and robots of a run fare");
  add_value(app, "run", c.run,
            "Its name of --run, the first digits of its number, or its scenario; not needed "
            "for the only one",
            "RUN");
  app.add_flag("--once", c.once, "Look on for a moment, print one table and end");
  app.add_flag("--json", c.json, "One JSON document in a line each time");
  app.add_flag("--robots", c.robots, "Also each robot");
  add_value(app, "--interval", c.interval_s, "Seconds between two looks [1; with --once 2.5]", "S")
      ->check(CLI::Range(0.1, 3600.0));
  add_network_options(app, c.bus);
  app.footer(
      "It only looks on: no process of the run waits for it. On a terminal q ends it and r shows\n"
      "or hides the robots. Exit code: 0; 2 if there is no such run.\n\n"
      "Examples:\n"
      "  rave top\n"
      "  rave top flock --once\n"
      "  rave top --interface 192.168.1.7 --peer 192.168.1.2 --peer 192.168.1.7 --json");
}

void add_doctor(CLI::App& root, DoctorCommand& c) {
  CLI::App& app = *root.add_subcommand("doctor", "Find out why two machines do not see each other");
  add_values(app, "--peers", c.bus.peers, "The other machines, as `a,b`, or one at a time", "ADDR")
      ->delimiter(',');
  add_network_options(app, c.bus);
  app.add_flag("--listen", c.listen, "Answer the doctor of another machine, until Ctrl-C");
  app.add_flag("--json", c.json, "Print the findings as JSON");
  app.footer(
      "It looks at this machine, and at the way to the peers where `rave doctor --listen` runs.\n"
      "Exit code: 0 if all is well, 1 if something was found, 2 for bad input.\n\n"
      "Examples:\n"
      "  rave doctor --listen --interface 192.168.1.2       # on the one machine\n"
      "  rave doctor --interface 192.168.1.7 --peers 192.168.1.2");
}

}  // namespace rave::cli
