// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "commands/hosts.hpp"
#include "commands/run.hpp"
#include "places.hpp"
#include "rave/base/text_width.hpp"
#include "shared_arguments.hpp"

namespace rave::cli {
namespace {

void add_paused(CLI::App& app, bool& paused) {
  app.add_flag("--paused", paused,
               "Start paused: `rave resume`, `rave step` or the page continues");
}

void add_run(CLI::App& root, Command& chosen) {
  const auto [app, c] = add_command(root, chosen, "run", "Run a scenario", run);
  add_scenario(app, c.scenario);
  add_run_options(app, c);
  add_paused(app, c.paused);
  app.add_flag("--dry-run", c.dry_run,
               "Print the plan of the run and start nothing: processes with their robots, people, "
               "what happens when");
  add_processes(app, c.processes, "Divide the robots evenly among N processes", 1);
  app.add_flag("--on-bus", c.on_bus,
               "Run the robots in a process of their own even if there is only one, so that `rave "
               "gui` and other monitors find the run");
  // Not for people: for a run that another process conducts.
  app.add_flag("--with-parent", c.with_parent)->group("");
  auto* const gui = app.add_flag(
      "--gui", c.gui,
      "Show the run in the browser (at --pace realtime unless set), then its recording, until "
      "Ctrl-C");
  add_page_options(app, c.page);
  app.get_option("--foxglove")->needs(gui);
  add_line_options(app, c.line);
  add_bus_options(app, c.bus);
  app.footer([] {
    const std::vector<std::string> names = shipped_scenarios();
    // Without the component that has them, for example where only recordings are shown.
    if (names.empty()) return std::string();
    return indented(
        fmt::format("Names of scenarios that come with RAVE: {}.", fmt::join(names, ", ")), 0, 90);
  });
  app.footer(
      "Exit code: 0 if the run completed and all checks hold, 1 if not, 2 for bad input.\n"
      "Ctrl-C and `rave end` end the run early and write its results: exit code 0 unless a check\n"
      "fails that had its time. A second Ctrl-C kills it.\n"
      "To control the run from another terminal, use `rave ps`, `stop`, `arm`, `set`, `edit` or\n"
      "`pause`.\n\n"
      "Examples:\n"
      "  rave run mixed-reality --pace 10x\n"
      "  rave run predator-prey --set robots.prey.pose.x_m=4\n"
      "  rave run my/scenario.yaml --seed 7 --duration 30 --output results");
}

void add_robot(CLI::App& root, Command& chosen) {
  const auto [app, c] =
      add_command(root, chosen, "robot", "Run the robots of one host of a scenario", robot);
  add_scenario(app, c.run.scenario);
  add_word(app, "--host", c.host, "Name of the host in the scenario", "NAME");
  add_value(app, "--wait-for-manager", c.manager_patience_s,
            "Seconds to wait for an environment manager [no limit]", "S")
      ->check(number_in(0.1, 1e9));
  // Not for people: for hosts that `rave run` starts.
  app.add_flag("--with-parent", c.run.with_parent)->group("");
  add_run_options(app, c.run);
  add_processes(app, c.run.processes, "Number of hosts among which the robots are divided", 2);
  add_line_options(app, c.run.line);
  add_bus_options(app, c.run.bus);
  app.footer(
      "The host waits for the environment manager of the run (`rave env`, or `rave run` of the "
      "same\n"
      "scenario). If the manager is lost, the host continues with the next one; in real time it\n"
      "also continues without one.\n"
      "Exit code: 0 if the host took part in all steps, or until it was ended by hand, 1 if not,\n"
      "2 for bad input.\n\n"
      "Examples:\n"
      "  rave robot lab --host left\n"
      "  rave robot lab --host left --interface 192.168.1.7 --peer 192.168.1.2");
}

void add_env(CLI::App& root, Command& chosen) {
  const auto [app, c] = add_command(
      root, chosen, "env",
      "Run the Environment Manager, which keeps the world that several hosts share", env);
  add_scenario(app, c.run.scenario);
  app.add_flag("--resume", c.resume,
               "Continue a run that lost its manager (default with on_lost_host: restart)");
  add_run_options(app, c.run);
  add_paused(app, c.run.paused);
  add_processes(app, c.run.processes,
                "Number of hosts, host-1 to host-N, among which the robots are divided", 2);
  add_bus_options(app, c.run.bus);
  app.footer(
      "Start the hosts with `rave robot`, before or after. If the manager dies, start another one\n"
      "with --resume to continue the run. Without --resume the new manager ignores hosts of a run\n"
      "that has begun; `rave end` ends them.\n"
      "Exit code: 0 if the run completed or was ended by hand, 1 if not, 2 for bad input.\n\n"
      "Examples:\n"
      "  rave env lab\n"
      "  rave env lab --resume");
}

}  // namespace

void add_run_commands(CLI::App& root, Command& chosen) {
  add_run(root, chosen);
  add_robot(root, chosen);
  add_env(root, chosen);
}

}  // namespace rave::cli
