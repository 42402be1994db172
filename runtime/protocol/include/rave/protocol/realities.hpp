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

/// Whether its real or its simulated drivers serve a robot that has both.
struct RobotReality {
  RobotId robot;
  bool simulated = true;
};

/// Hears from the roster (topic rave/roster) which drivers serve robots of other hosts. Must be
/// gone before its bus; thread: that of the bus.
class Realities {
 public:
  /// `host_of`: by robot, the number of its host in the scenario. Errors: those of
  /// bus::Reader::create().
  [[nodiscard]] static Result<Realities> create(bus::Bus& bus, std::uint32_t own_host,
                                                std::vector<std::uint32_t> host_of);

  /// Takes in what others say. Who speaks of a robot that its host does not run is refused, and
  /// told once as an event of the bus.
  void hear();
  /// Takes in what was heard, as hear() does with each sample of the topic.
  void hear(const bus::RosterEntry& entry);
  /// A process is gone, with what it said.
  void lose(std::uint64_t writer);
  /// What is otherwise than at the last call; ascending. Of several processes that speak for a
  /// host, such as one that was started by mistake, the one counts that was heard first.
  [[nodiscard]] std::vector<RobotReality> take();

 private:
  Realities(std::uint32_t own_host, std::vector<std::uint32_t> host_of,
            bus::Reader<bus::RosterEntry> reader)
      : own_host_(own_host), host_of_(std::move(host_of)), reader_(std::move(reader)) {}

  std::uint32_t own_host_;
  std::vector<std::uint32_t> host_of_;
  bus::Reader<bus::RosterEntry> reader_;
  /// What one process said of its robots: which are simulated.
  struct Book {
    std::uint64_t writer = 0;
    std::uint32_t host = 0;
    std::map<RobotId, bool> said;
  };
  std::vector<Book> books_;        ///< In the order in which they were begun.
  std::map<RobotId, bool> shown_;  ///< As handed out last.
  bool refused_ = false;
};

}  // namespace rave::real_time
