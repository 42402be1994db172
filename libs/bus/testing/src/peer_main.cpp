// SPDX-License-Identifier: Apache-2.0
// The other process of the tests of the bus: peer_bus ROLE name=value ...
#include <cstdio>
#include <cstdlib>
#include <string>

#include "rave/bus_testing/peer_roles.hpp"

int main(int argc, char** argv) {
  using namespace rave::bus;
  if (argc < 2) return 2;
  testing::Arguments arguments;
  for (int i = 2; i < argc; ++i) {
    const std::string word = argv[i];
    const auto equals = word.find('=');
    arguments[word.substr(0, equals)] = word.substr(equals + 1);
  }
  BusConfig config;
  config.participant = arguments["name"];
  config.domain = static_cast<std::uint32_t>(std::atoi(arguments["domain"].c_str()));
  config.tag = arguments["tag"];
  if (!arguments["peer"].empty()) config.peers = {arguments["peer"]};
  config.security = arguments["security"];
  if (const int lease_s = std::atoi(arguments["lease_s"].c_str()); lease_s > 0) {
    config.lease = rave::from_seconds(lease_s);
  }
  if (arguments["reach"] == "hub") config.reach = Reach::kHub;
  if (arguments["reach"] == "hubs") config.reach = Reach::kHubs;
  const auto run = RunId::parse(arguments["run"]);
  if (!run) return 2;
  config.run = *run;
  const auto bus = Bus::open(config);
  if (!bus) {
    std::printf("error %s\n", bus.error().text().c_str());
    return 1;
  }
  return testing::play(argv[1], **bus, arguments) ? 0 : 2;
}
