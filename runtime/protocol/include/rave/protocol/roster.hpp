// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/bus/writer.hpp"
#include "rave/sim/engine_spec.hpp"

namespace rave::lock_step {

/// Parameters of a robot by name, as text.
using NamedValues = std::vector<std::pair<std::string, std::string>>;

/// The description of a robot as a message that borrows memory of this object. One owner thread.
class RobotDescription {
 public:
  /// Valid until the next call; the caller sets revision and host. What exceeds the wire type is
  /// omitted: further shapes, sensors and parameters, and the ends of long texts. Values are
  /// written in one line.
  bus::RosterEntry& fill(const sim::EngineSpec& spec, RobotId robot, const NamedValues& parameters);

 private:
  void put_shape(const world::Shape& shape);
  void put_body(const world::Body& body);
  void put_sensors(const sim::RobotType& type);

  bus::RosterEntry entry_{};
  std::vector<rave_wire_Prism> prisms_;
  std::vector<double> x_m_, y_m_;
  std::vector<rave_wire_SensorMount> sensors_;
  std::vector<rave_wire_Parameter> parameters_;
};

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
    std::string name;        ///< Empty: nobody.
    std::uint64_t page = 0;  ///< 0: no particular one.
  };
  /// Publishes the marked robots in their present state. Does not block: a robot whose sample is
  /// not accepted, because a reader does not keep up, stays marked. `parameters_of` is called for
  /// each robot, and `driver_of`, which may be empty. Error kInvalidArgument: a robot cannot be
  /// described and is omitted.
  Status tell(const sim::EngineSpec& spec, const std::function<NamedValues(RobotId)>& parameters_of,
              const std::function<Driver(RobotId)>& driver_of = {});

 private:
  bus::Writer<bus::RosterEntry> writer_;
  std::uint32_t host_ = 0;
  std::uint64_t revision_ = 0;  ///< Counts all entries of this process.
  std::set<std::uint32_t> due_;
  RobotDescription description_;
};

}  // namespace rave::lock_step
