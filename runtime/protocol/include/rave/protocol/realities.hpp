// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "rave/base/ids.hpp"
#include "rave/bus/bus.hpp"
#include "rave/bus/reader.hpp"

namespace rave::real_time {

/// Which drivers are active for a robot that has both real and simulated ones.
struct RobotReality {
  RobotId robot;
  bool simulated = true;
};

/// Receives from the roster (topic rave/roster) which drivers are active for robots of other hosts.
/// Destroy it before its bus; thread: that of the bus.
class Realities {
 public:
  /// `host_of`: by robot, the number of its host in the scenario. Errors: those of
  /// bus::Reader::create().
  [[nodiscard]] static Result<Realities> create(bus::Bus& bus, std::uint32_t own_host,
                                                std::vector<std::uint32_t> host_of);

  /// Receives the pending samples. A sample about a robot of another host than its sender's is
  /// refused; the first one is reported as an event of the bus.
  void hear();
  /// Processes one sample, as hear() does for each.
  void hear(const bus::RosterEntry& entry);
  /// Forgets the samples of a process that was lost.
  void lose(std::uint64_t writer);
  /// The changes since the last call, ascending. If several processes speak for a host, such as one
  /// that was started by mistake, the first one counts.
  [[nodiscard]] std::vector<RobotReality> take();

 private:
  Realities(std::uint32_t own_host, std::vector<std::uint32_t> host_of,
            bus::Reader<bus::RosterEntry> reader)
      : own_host_(own_host), host_of_(std::move(host_of)), reader_(std::move(reader)) {}

  std::uint32_t own_host_;
  std::vector<std::uint32_t> host_of_;
  bus::Reader<bus::RosterEntry> reader_;
  /// The samples of one process: which of its robots are simulated.
  struct Book {
    std::uint64_t writer = 0;
    std::uint32_t host = 0;
    std::map<RobotId, bool> said;
  };
  std::vector<Book> books_;        ///< In order of creation.
  std::map<RobotId, bool> shown_;  ///< The state at the last take().
  bool refused_ = false;
};

}  // namespace rave::real_time
