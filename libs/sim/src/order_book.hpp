// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "answer_book.hpp"
#include "input_log.hpp"
#include "rave/robot/command.hpp"
#include "rave/robot/order.hpp"
#include "rave/sim/world_input.hpp"
#include "robot_guard.hpp"
#include "roster.hpp"

namespace rave::sim {

/// What people have asked of one robot.
struct OrderedRobot {
  /// The controller that does it in the place of the program; none: the program has the robot.
  std::optional<std::uint32_t> controller;
  Command command;         ///< For that controller, each step.
  bool driven = false;     ///< `command` is a velocity that a person ordered.
  double tolerance_m = 0;  ///< Of a goal for a controller: nearer than this is there.
  bool reached = false;    ///< It is there, and stays.
  /// The program executes the current order, or has completed it and got no other since.
  bool of_program = false;
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

/// A step in which orders are carried out. Views into the engine.
struct OrderMoment {
  std::uint64_t step = 0;
  SimTime now;
  std::span<const ReportedPose> reported;  ///< By robot.
  RunHash& hash;
  std::vector<Event>& events;  ///< Of the step.
};

/// What people have asked of robots that run here, and what becomes of it: orders wait for
/// programs, or take the place of what programs give to controllers. Costs nothing while it is
/// empty. Belongs to the thread of the engine.
class OrderBook {
 public:
  /// All must outlive it.
  OrderBook(const EngineSpec& spec, Roster& roster, InputLog& log)
      : spec_(spec), roster_(roster), log_(log) {}

  /// A run begins: there are no orders yet.
  void clear() { robots_.clear(); }
  [[nodiscard]] bool empty() const noexcept { return robots_.empty(); }
  /// Which orders a robot that runs here takes now.
  [[nodiscard]] OrderSet takes(RobotId robot) const;
  /// The order that a robot is carrying out, for people; empty: none.
  [[nodiscard]] std::string under_way(RobotId robot) const;

  // Between two steps; `step` comes next.

  /// A text, or an order to move, which `holds` and a hand-over may forbid. Errors: kState (it may
  /// not move), kInvalidArgument (the robot does not take it).
  Status take(std::uint64_t step, const WorldInput& input, const GuardHolds& holds,
              bool handed_over);
  /// Whether take() would; errors as there.
  [[nodiscard]] Status check(const WorldInput& input, const GuardHolds& holds,
                             bool handed_over) const;
  /// Ends what was asked of the robot of `input`, or of all if it has none.
  void cancel(std::uint64_t step, const WorldInput& input);
  /// Ends what was asked of one, without a note. False: there was nothing.
  bool end(RobotId robot, const Author& author);

  // In a step, in this order.

  /// Programs that decide in this step get what waits for them.
  void show(std::uint64_t step);
  /// What programs said becomes events, and part of the hash; orders may be done with it.
  void take_answers(const OrderMoment& moment, AnswerBook& answers);
  void hide();
  /// What is asked of controllers takes the place of what programs gave them.
  void steer(const OrderMoment& moment);

 private:
  [[nodiscard]] Status check_text(const WorldInput& input) const;
  /// The controller that carries out an order to move; none: the program does.
  [[nodiscard]] Result<std::optional<std::uint32_t>> taker(const WorldInput& input) const;
  void give_to_program(std::uint64_t step, const WorldInput& input);
  void give_to_controller(std::uint64_t step, const WorldInput& input, std::uint32_t controller);
  void tell_cancelled(const WorldInput& input, OrderedRobot& robot);
  void give_back(RobotId id, OrderedRobot& robot);
  [[nodiscard]] bool end(const WorldInput& input, RobotId id);
  static void look_at_goal(const OrderMoment& moment, RobotId id, OrderedRobot& robot);
  [[nodiscard]] OrderedRobot* find(RobotId robot) noexcept;

  const EngineSpec& spec_;
  Roster& roster_;
  InputLog& log_;
  std::map<std::uint32_t, OrderedRobot> robots_;  ///< By number: nothing for all others.
};

}  // namespace rave::sim
