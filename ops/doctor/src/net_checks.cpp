// SPDX-License-Identifier: Apache-2.0
#include <netdb.h>

#include <algorithm>
#include <memory>

#include "rave/doctor/checks.hpp"
#include "rave/doctor/ports.hpp"
#include "socket.hpp"

namespace rave::doctor {
namespace {

struct FreeFound {
  void operator()(::addrinfo* list) const noexcept { ::freeaddrinfo(list); }
};

/// The IPv4 address behind a name; empty if there is none.
std::string resolve(const std::string& name) {
  ::addrinfo wanted{};
  wanted.ai_family = AF_INET;
  wanted.ai_socktype = SOCK_DGRAM;
  ::addrinfo* raw = nullptr;
  if (::getaddrinfo(name.c_str(), nullptr, &wanted, &raw) != 0) return {};
  const std::unique_ptr<::addrinfo, FreeFound> list(raw);
  return place_of(*reinterpret_cast<const ::sockaddr_in*>(list->ai_addr)).address;
}

/// Sends a text that no other program sends, and whether it is received within `patience_ms` after
/// the last packet.
Result<bool> comes_back(const Socket& socket, const Place& to, int patience_ms) {
  const std::string probe = fmt::format("RAVE doctor {}", bus::RunId::random().text());
  RAVE_TRY(socket.send(probe, to));
  std::array<char, 2048> bytes{};
  for (int looks = 0; looks < 50; ++looks) {
    const auto received = socket.receive(bytes, patience_ms);
    if (!received || !*received) break;
    if (std::string_view(bytes.data(), (*received)->size) == probe) return true;
  }
  return false;
}

std::string address_on(const Machine& machine, const bus::BusConfig& config) {
  const Interface* const interface = machine.find(config.interface);
  return interface != nullptr ? interface->address : std::string();
}

}  // namespace

Finding check_peers(const Machine& machine, const bus::BusConfig& config,
                    std::vector<std::string>& addresses) {
  const bool multicast = config.multicast != bus::Multicast::kNone;
  bool self = false;
  std::vector<std::string> unknown;
  for (const std::string& peer : config.peers) {
    const std::string address = resolve(peer);
    if (address.empty()) {
      unknown.push_back(peer);
    } else if (machine.has_address(address)) {
      self = true;
    } else {
      addresses.push_back(address);
    }
  }
  if (!unknown.empty()) {
    return {"peers", Verdict::kProblem,
            fmt::format("no address is known for {}", fmt::join(unknown, ", ")),
            fmt::format("getent ahostsv4 {}    # name the address instead", unknown.front())};
  }
  const bool local = config.loopback() && addresses.empty();
  if (local) return {"peers", Verdict::kGood, "this machine only", {}};
  if (addresses.empty() && !multicast) {
    return {"peers", Verdict::kProblem, "without peers and without multicast, no process is found",
            "--peer ADDRESS    # of each machine that takes part, this one included"};
  }
  // Without multicast a process sends its announcements only to the listed peers, so this machine
  // must be in the list for its own processes.
  if (!self && !multicast) {
    const std::string own = address_on(machine, config);
    return {"peers", Verdict::kAdvice,
            fmt::format(
                "{}; this machine is not in the list, so its own processes do not find each other",
                fmt::join(addresses, ", ")),
            fmt::format("--peer {}", own.empty() ? "ADDRESS" : own)};
  }
  return {"peers",
          Verdict::kGood,
          addresses.empty() ? "found by multicast" : fmt::format("{}", fmt::join(addresses, ", ")),
          {}};
}

Finding check_ports(const bus::BusConfig& config) {
  const std::uint32_t domain = std::min(config.domain, kMostDomain);
  const std::uint16_t group = multicast_port(domain);
  const std::string any = "0.0.0.0";
  // Shared, as Cyclone DDS binds it: all processes of a machine listen at this port. Only a program
  // that does not share it is in the way.
  if (const auto shared = Socket::bind({any, group}, true); !shared) {
    return {
        "ports", Verdict::kProblem,
        fmt::format("UDP port {} for multicast is used exclusively by another program ({})", group,
                    shared.error().message),
        fmt::format("sudo ss -ulpn 'sport = :{}'    # lists the program; or use another --domain",
                    group)};
  }
  int taken = 0;
  for (int index = 0; index < config.max_processes; ++index) {
    const bool free = Socket::bind({any, discovery_port(domain, index)}).has_value() &&
                      Socket::bind({any, data_port(domain, index)}).has_value();
    taken += free ? 0 : 1;
  }
  const int first = discovery_port(domain, 0);
  const int last = data_port(domain, config.max_processes - 1);
  if (taken == config.max_processes) {
    return {"ports", Verdict::kProblem,
            fmt::format("all UDP ports from {} to {} are in use", first, last),
            fmt::format("sudo ss -ulpn 'sport >= :{} and sport <= :{}'    # lists the programs; or "
                        "use another --domain",
                        first, last)};
  }
  return {"ports",
          Verdict::kGood,
          taken == 0 ? fmt::format("{} to {} are free", first, last)
                     : fmt::format("{} of {} are in use by processes; the others are free", taken,
                                   config.max_processes),
          {}};
}

Finding check_own_way(const Machine& machine, const bus::BusConfig& config) {
  const std::string address = address_on(machine, config);
  if (address.empty()) {
    return {"self", Verdict::kUnknown, "no interface to test", {}};
  }
  const std::uint32_t domain = std::min(config.domain, kMostDomain);
  for (int index = 0; index < config.max_processes; ++index) {
    const std::uint16_t port = data_port(domain, index);
    const auto socket = Socket::bind({address, port});
    if (!socket) continue;
    // To its own address and not to loopback: that is the way packets of processes on one machine
    // take with this interface.
    if (comes_back(*socket, {address, port}, 300).value_or(false)) {
      return {
          "self", Verdict::kGood, fmt::format("{} reaches its own UDP port {}", address, port), {}};
    }
    return {"self", Verdict::kProblem,
            fmt::format(
                "packets from {} to its own UDP port {} do not arrive: a packet filter drops them",
                address, port),
            fmt::format("sudo nft list ruleset    # shows the rules; accept UDP {} to {}",
                        first_port(domain), last_port(domain))};
  }
  return {"self", Verdict::kUnknown, "no free port for the test", {}};
}

Finding check_multicast(const Machine& machine, const bus::BusConfig& config) {
  Finding finding{"multicast"};
  if (config.multicast == bus::Multicast::kNone) {
    finding.what = "not used";
    return finding;
  }
  const Interface* const interface = machine.find(config.interface);
  if (interface == nullptr || interface->address.empty()) {
    return {"multicast", Verdict::kUnknown, "no interface to test", {}};
  }
  const std::string by_list =
      "--multicast none --peer ADDRESS    # of each machine; works without multicast";
  if (!interface->multicast && !interface->loopback) {
    return {"multicast", Verdict::kProblem,
            fmt::format("{} does not support multicast", interface->name),
            fmt::format("sudo ip link set {} multicast on", interface->name)};
  }
  const std::uint16_t port = multicast_port(std::min(config.domain, kMostDomain));
  auto socket = Socket::bind({"0.0.0.0", port}, true);
  const Status joined = socket ? socket->join(kMulticastGroup, interface->address)
                               : Status(tl::unexpected(socket.error()));
  const Result<bool> back = joined ? comes_back(*socket, {kMulticastGroup, port}, 100)
                                   : Result<bool>(tl::unexpected(joined.error()));
  if (!back) {
    return {"multicast", Verdict::kProblem,
            fmt::format("cannot send to {} through {} ({})", kMulticastGroup, interface->name,
                        back.error().message),
            fmt::format("sudo ip route add 224.0.0.0/4 dev {}", interface->name)};
  }
  if (*back) {
    finding.what = fmt::format("{}:{} works on {}", kMulticastGroup, port, interface->name);
    return finding;
  }
  return {"multicast", Verdict::kProblem,
          fmt::format("packets sent to {}:{} through {} do not come back: a packet filter drops "
                      "them, or they leave through another interface",
                      kMulticastGroup, port, interface->name),
          by_list};
}

}  // namespace rave::doctor
