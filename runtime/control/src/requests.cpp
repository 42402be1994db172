// SPDX-License-Identifier: Apache-2.0
#include "rave/control/requests.hpp"

#include <fmt/format.h>

#include "rave/assemble/obstacles.hpp"
#include "rave/assemble/parameter_key.hpp"
#include "rave/assemble/twins.hpp"
#include "rave/base/names.hpp"
#include "rave/control/obstacle_edits.hpp"
#include "rave/control/order_words.hpp"
#include "rave/control/world_request.hpp"

namespace rave::runtime {
namespace {

std::uint32_t robot_count(const sim::Engine& engine) {
  return static_cast<std::uint32_t>(engine.spec().robots.size());
}

/// The names of the robots for which `holds` is true, of one robot or of all.
template <class Holds>
std::string names_of(const sim::Engine& engine, RobotId robot, Holds&& holds) {
  std::vector<std::string_view> names;
  for (std::uint32_t r = 0; r < robot_count(engine); ++r) {
    if (robot.valid() && robot.value() != r) continue;
    if (!engine.is_local(RobotId(r))) continue;
    if (holds(RobotId(r))) names.emplace_back(engine.spec().robots[r].name);
  }
  constexpr std::size_t kMany = 12;
  if (names.size() > kMany) return fmt::format("{} robots", names.size());
  return names.empty() ? std::string() : join_names(names);
}

Result<std::string> arm(sim::Engine& engine, RobotId robot, const sim::Author& author) {
  const std::string stopped = names_of(engine, robot, [&](RobotId r) { return engine.stopped(r); });
  const std::string waiting = names_of(engine, robot, [&](RobotId r) { return !engine.armed(r); });
  if (!stopped.empty()) {
    return fail(ErrorCode::kState, "stopped: {}; a stop holds until it is released (`--release`)",
                stopped);
  }
  if (waiting.empty()) return std::string("nothing to arm: no robot waits to be armed");
  for (std::uint32_t r = 0; r < robot_count(engine); ++r) {
    if ((robot.valid() && robot.value() != r) || engine.armed(RobotId(r))) continue;
    const std::string trouble = engine.drive_trouble(RobotId(r));
    if (trouble.empty()) continue;
    return fail(ErrorCode::kState, "robot `{}` cannot be driven: {}", engine.spec().robots[r].name,
                trouble);
  }
  engine.arm(robot, author);
  return "armed " + waiting;
}

/// Executes what is asked between two steps.
struct Serve {
  sim::Engine& engine;
  const request::Request& request;
  RobotId robot;
  sim::Author author;

  Result<std::string> operator()(const request::Stop& stop) const;
  Result<std::string> operator()(const request::Release& release) const;
  Result<std::string> operator()(const request::Arm& /*arm*/) const {
    return arm(engine, robot, author);
  }
  Result<std::string> operator()(const request::Set& set) const;
  Result<std::string> operator()(const request::Edit& edit) const;
  Result<std::string> operator()(const request::ListObstacles& /*list*/) const {
    return list_obstacles(engine.spec().world);
  }
  Result<std::string> operator()(const request::HandOver& hand_over) const;
  Result<std::string> operator()(const request::ResetShadow& /*reset*/) const {
    return fail(ErrorCode::kNotFound, "no robot of the run has a shadow");
  }
  Result<std::string> operator()(const request::Take& /*take*/) const { return no_leases(); }
  Result<std::string> operator()(const request::Give& /*give*/) const { return no_leases(); }
  Result<std::string> operator()(const request::Chat& /*chat*/) const {
    return fail(ErrorCode::kState, "this process keeps no chat");
  }
  template <request::IsOrder One>
  Result<std::string> operator()(const One& /*order*/) const {
    return order();
  }

 private:
  [[nodiscard]] static Result<std::string> no_leases() {
    return fail(ErrorCode::kState, "this process keeps no leases");
  }
  [[nodiscard]] Result<std::string> order() const;
};

Result<std::string> Serve::operator()(const request::Stop& /*stop*/) const {
  engine.stop(robot, author);
  return "stopped " + names_of(engine, robot, [](RobotId) { return true; });
}

Result<std::string> Serve::operator()(const request::Release& /*release*/) const {
  const std::string names = names_of(engine, robot, [&](RobotId r) { return engine.stopped(r); });
  engine.release(robot, author);
  return names.empty() ? std::string("nothing to release: no robot is stopped")
                       : "released " + names;
}

Result<std::string> Serve::operator()(const request::Set& set) const {
  RAVE_TRY_ASSIGN(const auto change, requested_parameter(engine.spec(), robot, set));
  const std::string before = engine.parameter(robot, change.part, change.index, change.name);
  RAVE_TRY(engine.set_parameters(robot, std::span(&change, 1), author));
  return fmt::format("{}: {}: {} -> {}", request.robot, set.key, before,
                     engine.parameter(robot, change.part, change.index, change.name));
}

Result<std::string> Serve::operator()(const request::Edit& edit) const {
  RAVE_TRY_ASSIGN(const sim::ObstacleChange change, requested_change(edit.edit, request.by));
  RAVE_TRY_ASSIGN(const sim::ChangedObstacle made, engine.change_obstacle(change, author));
  const double from_s = static_cast<double>(made.step) * engine.spec().step.seconds();
  return fmt::format("{} {}; counts from step {} on, at {:.3f} s", word_of(change.kind), made.text,
                     made.step, from_s);
}

/// A robot without a pose cannot be sent to a place.
Status check_pose(const sim::Engine& engine, const sim::WorldInput& input) {
  if (!input.is<request::Goal>() && !input.is<request::Path>()) return {};
  const sim::ReportedPose& pose = engine.reported(input.robot);
  if (engine.steps_done() == 0 || (pose.known && !pose.stale)) return {};
  return fail(ErrorCode::kState, "robot `{}`: its pose is not known at present",
              engine.spec().robots[input.robot.value()].name);
}

Result<std::string> Serve::order() const {
  RAVE_TRY_ASSIGN(const sim::WorldInput input, input_for(engine.spec(), request));
  RAVE_TRY(check_pose(engine, input));
  RAVE_TRY(engine.order(input));
  return order_answer(request);
}

Result<std::string> Serve::operator()(const request::HandOver& hand_over) const {
  if (!robot.valid()) return fail(ErrorCode::kInvalidArgument, "expected the robot to hand over");
  RAVE_TRY_ASSIGN(const config::HandOverTo to, hand_over_word(hand_over.to));
  const auto state = engine.hand_over_state(robot);
  const sim::DriverSet active = state ? state->active : sim::DriverSet::kFirst;
  RAVE_TRY_ASSIGN(const sim::DriverSet set, driver_set(engine.spec(), robot, active, to));
  RAVE_TRY(engine.hand_over(robot, set, author));
  return fmt::format("robot `{}` is being handed over to its {} drivers", request.robot,
                     hand_over.to);
}

}  // namespace

Result<RobotId> find_robot_here(const sim::Engine& engine, std::string_view name) {
  RAVE_TRY_ASSIGN(const RobotId robot, find_robot(engine.spec(), name));
  if (engine.is_local(robot)) return robot;
  return fail(ErrorCode::kNotFound, "robot `{}` runs in another process of this run", name);
}

Status check_order_now(const sim::Engine& engine, const sim::WorldInput& input) {
  RAVE_TRY(engine.check_order(input));
  return check_pose(engine, input);
}

Result<std::string> serve_request(sim::Engine& engine, const request::Request& request) {
  RobotId robot;
  if (!request.robot.empty()) {
    RAVE_TRY_ASSIGN(robot, find_robot_here(engine, request.robot));
  }
  return std::visit(Serve{engine, request, robot, {true, request.by}}, request.action);
}

void refresh_status(const sim::Engine& engine, RunStatus& status) {
  const sim::EngineSpec& spec = engine.spec();
  // Updates in place: with many robots most entries do not change.
  std::size_t count = 0;
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    if (!engine.is_local(RobotId(r))) continue;
    if (status.robots.size() == count) status.robots.emplace_back();
    RunStatus::Robot& robot = status.robots[count++];
    robot.hand_over.reset();
    robot.shadow.reset();
    robot.lease.clear();
    robot.lease_page = 0;
    robot.order = engine.order_of(RobotId(r));
    robot.changed = changed_values(engine, RobotId(r));
    write_takes(engine.takes(RobotId(r)), robot.takes);
    robot.name = spec.robots[r].name;
    robot.simulated = spec.types[spec.robots[r].type].simulated;
    robot.armed = engine.armed(RobotId(r));
    robot.stopped = engine.stopped(RobotId(r));
    robot.lacks = engine.lacks(RobotId(r));
    const auto hand_over = engine.hand_over_state(RobotId(r));
    if (!hand_over) continue;
    const Pose2 X_WR = engine.snapshot().pose(RobotId(r));
    robot.hand_over = {hand_over->under_way,
                       hand_over->made,
                       hand_over->refused,
                       hand_over->last,
                       X_WR.x,
                       X_WR.y,
                       X_WR.yaw};
  }
  status.robots.resize(count);
}

std::string unarmed_robots(const sim::Engine& engine) {
  return names_of(engine, RobotId(), [&](RobotId r) { return !engine.armed(r); });
}

}  // namespace rave::runtime
