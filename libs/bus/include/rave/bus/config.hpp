// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/bus/run_id.hpp"

namespace rave::bus {

/// How multicast is used.
enum class Multicast : std::uint8_t {
  kNone,       ///< Not at all: processes are found at the addresses of `peers`.
  kDiscovery,  ///< For discovery only; data is unicast.
  kData,       ///< For discovery and for data with several receivers.
};

/// The names of Multicast in files, on the command line and in reports, in its order.
inline constexpr std::array<const char*, 3> kMulticastNames{"none", "discovery", "data"};

/// The value of one of kMulticastNames; none for other words.
[[nodiscard]] std::optional<Multicast> multicast_of(std::string_view name) noexcept;

/// Which processes a process tries to discover. If all look for all, the traffic grows with the
/// square of their number.
enum class Reach : std::uint8_t {
  kAll,   ///< All processes.
  kHub,   ///< All processes; those with kHubs look for this one too.
  kHubs,  ///< Hubs only. Other processes find this one if they look for it.
};

/// The processes of a run with which this process exchanges samples. Hosts are in both DDS
/// partitions of the run. The manager is in one, monitors are in the other, so manager and monitors
/// neither receive from nor delay each other.
enum class Side : std::uint8_t {
  kAll,      ///< All; used by hosts.
  kManager,  ///< Hosts only, in the partition `rave/RUN`; used by the manager.
  kMonitor,  ///< Hosts only, in the partition `rave/RUN/hosts`; used by monitors.
};

/// How a process joins the bus. A plain value; the defaults stay on this machine.
struct BusConfig {
  /// The name shown to others in events and tables: 1 to 64 bytes.
  std::string participant;
  /// The run; must be set unless `anonymous`.
  RunId run;
  /// For a process that is not part of a run and only observes or sends requests. It announces its
  /// name alone, so others never count it as a member of a run. Without a run it discovers
  /// processes but receives no samples.
  bool anonymous = false;
  /// For an anonymous process without a run: it exchanges samples with the processes of all runs of
  /// the domain. Each sample that it writes must name its run.
  bool all_runs = false;
  Side side = Side::kAll;
  /// The DDS domain, 0 to 230. It determines the UDP ports: 7400 + 250 * domain and up.
  std::uint32_t domain = 0;
  /// The network interface, by address (`192.168.1.7`) or by name (`eth0`).
  std::string interface = "127.0.0.1";
  /// Addresses or names of the machines to look for processes on, including this one. On the
  /// loopback interface an empty list means this machine.
  std::vector<std::string> peers;
  Multicast multicast = Multicast::kNone;
  /// Largest number of processes per machine in a domain, over all runs: 1 to 119. Without
  /// multicast, discovery sends messages to each of these ports, so a larger number costs traffic.
  int max_processes = 64;
  /// Has an effect without multicast only. Hubs use reserved ports, after those of `kMostPlain`
  /// other processes; a machine has kMostHubs of them per domain.
  Reach reach = Reach::kAll;
  static constexpr int kMostPlain = 114;
  static constexpr int kMostHubs = 6;
  /// A process that was silent for longer than this counts as lost.
  Duration lease{1'000'000'000};
  /// Processes with different tags do not discover each other, whatever their run. Usually empty.
  std::string tag;
  /// Permits other buses of this process in the domain; this one then counts as another process.
  /// For drivers, whose host may have a bus of its own.
  bool beside = false;
  /// A folder with certificates; if set, DDS Security is on. See docs/explanation/security.md.
  std::filesystem::path security;
  /// Whether small samples of lock-step use the local transport, beside DDS, between processes of
  /// this machine. Ignored with `security` and if `anonymous`.
  bool local_transport = true;
  /// Settings of Cyclone DDS: its own XML, or `file://...`. They override those made from the other
  /// members. The environment variable CYCLONEDDS_URI is not read; a caller may copy it here.
  std::string cyclone_settings;

  /// Whether `interface` is the loopback interface.
  [[nodiscard]] bool loopback() const;
};

/// Checks the configuration. Error kInvalidArgument names the field.
[[nodiscard]] Status validate(const BusConfig& config);

/// The Cyclone DDS settings of a valid configuration. `hub`: the reserved port that a hub uses,
/// below BusConfig::kMostHubs.
[[nodiscard]] std::string cyclone_xml(const BusConfig& config, int hub = 0);

}  // namespace rave::bus
