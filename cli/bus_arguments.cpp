// SPDX-License-Identifier: Apache-2.0
#include "bus_arguments.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace rave::cli {

void add_network_options(CLI::App& app, BusOptions& c) {
  app.add_option("--domain", c.domain, "DDS domain of a run with several processes [0]")
      ->type_name("N")
      ->check(CLI::Range(0, 230));
  app.add_option("--interface", c.interface,
                 "Address or name of the network interface [this machine only]")
      ->type_name("ADDR");
  app.add_option("--peer", c.peers, "A machine to look for others at; may be repeated")
      ->type_name("ADDR")
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--multicast", c.multicast, "off, discovery (to find one another) or on")
      ->type_name("USE");
  app.add_option("--security", c.security,
                 "Folder with the certificates of this process, as `rave keys` makes them")
      ->type_name("DIR");
  // Not for people: keeps tests on one machine apart.
  app.add_option("--bus-tag", c.tag)->group("");
}

void add_bus_options(CLI::App& app, BusOptions& c) {
  app.add_option("--run", c.run, "Name of the run, the same for all its processes [its scenario]")
      ->type_name("NAME");
  add_network_options(app, c);
}

}  // namespace rave::cli
