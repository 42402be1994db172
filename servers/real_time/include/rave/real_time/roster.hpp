// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "rave/bus/bus.hpp"
#include "rave/bus/reader.hpp"
#include "rave/bus/writer.hpp"
#include "rave/sim/engine.hpp"

namespace rave::real_time {

/// Whether its real or its simulated drivers serve a robot that has both.
struct RobotReality {
  RobotId robot;
  bool simulated = true;
};

/// Tells others which drivers serve robots of this host, and hears that of theirs (topic
/// rave/roster). Must be gone before its bus; thread: that of the bus.
class Roster {
 public:
  /// `host_of`: by robot, the number of its host in the scenario. Errors: those of
  /// bus::Writer::create().
  [[nodiscard]] static Result<Roster> create(bus::Bus& bus, std::uint32_t own_host,
                                             std::vector<std::uint32_t> host_of);

  /// Tells which drivers serve a robot of this host, also those who come later.
  void tell(const sim::Engine& engine, RobotId robot);
  /// Takes in what others say. Who speaks of a robot that its host does not run is refused, and
  /// told once as an event of the bus.
  void hear();
  /// What was heard since the last call, of each robot the last; ascending.
  [[nodiscard]] std::vector<RobotReality> take();

 private:
  Roster(std::uint32_t own_host, std::vector<std::uint32_t> host_of,
         bus::Writer<bus::RosterEntry> writer, bus::Reader<bus::RosterEntry> reader)
      : own_host_(own_host),
        host_of_(std::move(host_of)),
        writer_(std::move(writer)),
        reader_(std::move(reader)) {}

  std::uint32_t own_host_;
  std::vector<std::uint32_t> host_of_;
  bus::Writer<bus::RosterEntry> writer_;
  bus::Reader<bus::RosterEntry> reader_;
  std::map<RobotId, bool> heard_;                 ///< Simulated?
  std::map<RobotId, std::uint64_t> revision_of_;  ///< Of those that were told.
  bool refused_ = false;
};

}  // namespace rave::real_time
