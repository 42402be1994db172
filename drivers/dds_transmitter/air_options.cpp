// SPDX-License-Identifier: Apache-2.0
#include "dds_transmitter/air_options.hpp"

#include "dds_network/network_words.hpp"
#include "rave/base/named_path.hpp"

namespace rave::dds_transmitter {
namespace {

/// Separates these participants from those of hosts: they do not discover each other.
constexpr const char* kTag = "rave radio";

}  // namespace

bus::RunId run_of_network(std::string_view network) { return bus::run_of_name(network); }

Result<AirOptions> read_options(const HardwareSetup& setup) {
  const Params params = setup.parameters();
  AirOptions options;
  options.network = params.text("network");
  options.run = run_of_network(options.network);
  if (!params.text("run").empty()) {
    auto run = bus::RunId::parse(params.text("run"));
    if (!run) return tl::unexpected(std::move(run).error().with_context("`run`"));
    options.run = *run;
  }
  dds_network::read_network(params, options);
  if (const std::string_view folder = params.text("security"); !folder.empty()) {
    options.security = named_path(setup.folder, folder).string();
  }
  options.max_packet_bytes = static_cast<std::size_t>(params.integer("max_packet_bytes"));
  options.queue_bytes = static_cast<std::size_t>(params.integer("queue_bytes"));
  return options;
}

bus::BusConfig bus_config(const AirOptions& options) {
  bus::BusConfig config;
  config.participant = "radio/" + options.network.substr(0, 50);
  config.run = options.run;
  config.domain = options.domain;
  config.interface = options.interface;
  config.peers = options.peers;
  config.multicast = options.multicast;
  config.security = options.security;
  config.tag = kTag;
  config.beside = true;
  return config;
}

}  // namespace rave::dds_transmitter
