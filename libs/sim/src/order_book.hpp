// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "rave/robot/command.hpp"
#include "rave/robot/order.hpp"
#include "rave/sim/world_input.hpp"

namespace rave::sim {

/// What people have asked of one robot.
struct OrderedRobot {
  /// The controller that does it in the place of the program; none: the program has the robot.
  std::optional<std::uint32_t> controller;
  Command command;                  ///< For that controller, each step.
  bool driven = false;              ///< `command` is a velocity of somebody.
  double tolerance_m = 0;           ///< Of a goal for a controller: nearer than this is there.
  bool reached = false;             ///< It is there, and stays.
  bool of_program = false;          ///< The program does the order under way.
  std::string under_way;            ///< For people; empty: nothing.
  std::string by;                   ///< Who asked for it.
  std::vector<WorldInput> waiting;  ///< For the next decision.
  std::vector<WorldInput> shown;    ///< In this decision; `items` point into it.
  std::vector<OrderItem> items;

  /// Puts an order behind those that wait. Of goals, paths and cancels only the last one counts; of
  /// texts the oldest gives way.
  void wait_for_program(const WorldInput& input);
  /// What waits becomes what is shown.
  void show();
};

/// The robots that people have asked something of, by number: nothing for all others.
class OrderBook {
 public:
  [[nodiscard]] OrderedRobot& at(RobotId robot) { return robots_[robot.value()]; }
  [[nodiscard]] OrderedRobot* find(RobotId robot) noexcept {
    const auto found = robots_.find(robot.value());
    return found == robots_.end() ? nullptr : &found->second;
  }
  [[nodiscard]] std::map<std::uint32_t, OrderedRobot>& robots() noexcept { return robots_; }

 private:
  std::map<std::uint32_t, OrderedRobot> robots_;
};

}  // namespace rave::sim
