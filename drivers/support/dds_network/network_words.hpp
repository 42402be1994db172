// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rave/bus/config.hpp"
#include "rave/plugin/params.hpp"

namespace rave::dds_network {

/// The parameter `domain`.
constexpr ParamSpec domain_param(const char* doc) noexcept {
  return integer_param("domain", 0, 0, 230, doc);
}

/// The addresses in a parameter `peers`, separated by commas; blanks are ignored.
[[nodiscard]] std::vector<std::string> split_peers(std::string_view text);

/// Copies the parameters `domain`, `interface`, `peers` and `multicast` to members of these names,
/// such as those of bus::BusConfig.
template <class Network>
void read_network(const Params& params, Network& network) {
  network.domain = static_cast<std::uint32_t>(params.integer("domain"));
  network.interface = params.text("interface");
  network.peers = split_peers(params.text("peers"));
  network.multicast = bus::multicast_of(params.text("multicast")).value_or(bus::Multicast::kNone);
}

}  // namespace rave::dds_network
