// SPDX-License-Identifier: Apache-2.0
#include "bus_arguments.hpp"

#include "shared_arguments.hpp"

namespace rave::cli {

void add_network_options(CLI::App& app, BusOptions& c) {
  add_value(app, "--domain", c.domain, "DDS domain of a run with several processes [0]", "N")
      ->check(whole_number_in(0, 230));
  add_value(app, "--interface", c.interface,
            "Network interface, by address or name [this machine only]", "ADDR");
  add_values(app, "--peer", c.peers,
             "Address of a machine with other processes of the run; repeatable", "ADDR");
  add_value(app, "--multicast", c.multicast,
            "Use of multicast: none, discovery (only to find processes) or data (for both) [none]",
            "USE");
  add_value(app, "--security", c.security,
            "Encrypt; folder with the certificates of this process, made by `rave keys`", "DIR");
  // Not for people: keeps tests on one machine apart, and lets a benchmark count what goes by DDS.
  app.add_option("--bus-tag", c.tag)->group("");
  app.add_flag("--dds-only", c.dds_only)->group("");
}

void add_bus_options(CLI::App& app, BusOptions& c) {
  add_value(app, "--run", c.run,
            "Name of the run, the same for all of its processes [name of the scenario]", "NAME");
  add_network_options(app, c);
}

}  // namespace rave::cli
