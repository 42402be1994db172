// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "rave/base/result.hpp"
#include "rave/bus/writer.hpp"
#include "rave/sim/engine_spec.hpp"

namespace rave::lock_step {

/// The description of a robot; the publisher sets the host. The ends of long names are omitted.
[[nodiscard]] bus::RosterEntry describe(const sim::EngineSpec& spec, RobotId robot);

/// Publishes the descriptions of a host's robots (topic rave/roster): each once, and again after a
/// change. Destroy it before its bus; thread: that of the bus.
class Roster {
 public:
  /// Comes before any tell(). `host`: its number in the scenario. Errors: those of
  /// bus::Writer::open().
  [[nodiscard]] Status open(bus::Bus& bus, std::uint32_t host) {
    host_ = host;
    return writer_.open(bus);
  }

  /// Marks a robot of this host as new or changed.
  void note(RobotId robot) { due_.insert(robot.value()); }
  void note(std::span<const RobotId> robots) {
    for (const RobotId robot : robots) note(robot);
  }
  /// Whether any robot is marked.
  [[nodiscard]] bool due() const noexcept { return !due_.empty(); }

  /// Who has the command lease of a robot.
  struct Driver {
    std::string name;        ///< Empty: no person.
    std::uint64_t page = 0;  ///< 0: no particular one.
  };
  /// Publishes the marked robots in their present state. Does not block: a robot whose sample is
  /// not accepted, because a reader does not keep up, stays marked. `driver_of`, which may be
  /// empty, is called for each robot. Error kInvalidArgument: a robot cannot be described and is
  /// omitted.
  Status tell(const sim::EngineSpec& spec, const std::function<Driver(RobotId)>& driver_of = {});

 private:
  bus::Writer<bus::RosterEntry> writer_;
  std::uint32_t host_ = 0;
  std::set<std::uint32_t> due_;
};

}  // namespace rave::lock_step
