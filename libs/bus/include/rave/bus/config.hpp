// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/bus/run_id.hpp"

namespace rave::bus {

/// What multicast is used for.
enum class Multicast : std::uint8_t {
  kOff,        ///< Nothing: processes are found at the addresses of `peers`.
  kDiscovery,  ///< To find processes; data goes to each by itself.
  kOn,         ///< For data to several receivers too.
};

/// Whom a process looks for. Where all look for all, the effort grows with the square of their
/// number.
enum class Reach : std::uint8_t {
  kAll,   ///< Every process.
  kHub,   ///< The same; it is also found by those that look for hubs.
  kHubs,  ///< Hubs. Others find this process if they look for it.
};

/// Whom a process of a run exchanges messages with. Hosts are in both partitions of the run, so
/// that its manager and those who look on neither hear nor hold up each other.
enum class Side : std::uint8_t {
  kAll,      ///< Everybody; as hosts do.
  kManager,  ///< Hosts, in the partition `rave/RUN` alone.
  kMonitor,  ///< Hosts, in the partition `rave/RUN/hosts` alone.
};

/// How a process takes part in a run. A plain value; the defaults stay on this machine.
struct BusConfig {
  /// Shown to others, in events and tables: 1 to 64 bytes.
  std::string participant;
  /// Must not be none, unless `anonymous`.
  RunId run;
  /// For those who take no part and only look, or ask: others are told the name alone, so no
  /// process takes this one for a part of a run, or of another run. Without a run it sees who is
  /// there and no samples.
  bool anonymous = false;
  Side side = Side::kAll;
  /// 0 to 230: chooses the UDP ports, 7400 + 250 * domain and up.
  std::uint32_t domain = 0;
  /// The network interface, by address (`192.168.1.7`) or by name (`eth0`).
  std::string interface = "127.0.0.1";
  /// Addresses or names of machines to look for others at, this one included. On loopback an empty
  /// list means this machine.
  std::vector<std::string> peers;
  Multicast multicast = Multicast::kOff;
  /// Most processes of one machine in a domain, of this and other runs: 1 to 119. Without multicast
  /// each of them is looked for, so a larger number costs messages.
  int max_processes = 64;
  /// Counts without multicast only. Hubs have places of their own, behind those of `kMostPlain`
  /// other processes; a machine has room for six in a domain.
  Reach reach = Reach::kAll;
  static constexpr int kMostPlain = 114;
  static constexpr int kMostHubs = 6;
  /// A process that has been silent for this long is lost.
  Duration lease{1'000'000'000};
  /// Processes with another tag do not exist for this one, whatever their run. Usually empty.
  std::string tag;
  /// Another bus of this process may be in the domain already; this one is then beside it as that
  /// of another process would be. For drivers, whose host may have a bus of its own.
  bool beside = false;
  /// A folder with certificates switches DDS Security on; see docs/explanation/security.md.
  std::filesystem::path security;
  /// Small samples of lock-step may go from process to process of this machine beside DDS. Never
  /// with `security`, nor for those who are `anonymous`.
  bool short_way = true;
  /// Settings of Cyclone DDS in its own XML, or `file://...`, which win over those made from the
  /// rest. The variable CYCLONEDDS_URI counts only if somebody puts its value here.
  std::string cyclone_settings;

  /// Whether `interface` is this machine's loopback.
  [[nodiscard]] bool loopback() const;
};

/// Whether a bus can be made of it. Error kInvalidArgument names the field.
[[nodiscard]] Status validate(const BusConfig& config);

/// The settings of Cyclone DDS that follow from a valid configuration. `hub`: which of the places
/// of hubs a hub takes, below BusConfig::kMostHubs.
[[nodiscard]] std::string cyclone_xml(const BusConfig& config, int hub = 0);

}  // namespace rave::bus
