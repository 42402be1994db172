// SPDX-License-Identifier: Apache-2.0
#include "script_world.hpp"

#include <cmath>
#include <utility>

#include "rave/base/names.hpp"
#include "rave/base/random.hpp"
#include "rave/math/scalar.hpp"

namespace rave::runtime {

using script::Value;

ScriptWorld::ScriptWorld(std::vector<std::string> robots, std::uint64_t seed)
    : robots_(std::move(robots)), seed_(seed) {
  for (std::uint32_t r = 0; r < robots_.size(); ++r) ids_.emplace(robots_[r], r);
}

Status ScriptWorld::check_world() const {
  if (world_ != nullptr) return {};
  return fail(ErrorCode::kState, "there is no world yet; ask in on_start() or on_step()");
}

std::string ScriptWorld::nearest(std::string_view name) const {
  const std::vector<std::string_view> names(robots_.begin(), robots_.end());
  return suggestion(name, names);
}

Result<std::optional<Pose2>> ScriptWorld::place(const Value& value) const {
  RAVE_TRY(check_world());
  if (const std::string* const name = value.text()) {
    if (const auto robot = ids_.find(*name); robot != ids_.end()) {
      return world_->pose(robot->second);
    }
    // An obstacle may be gone, or yet to come: no mistake.
    return world_->obstacle(*name);
  }
  const Value* const x = value.find(1);
  const Value* const y = value.find(2);
  if (x == nullptr || y == nullptr) {
    return fail(ErrorCode::kInvalidArgument, "expected a name or a place {{x, y}}, found {}",
                script::kind_text(value));
  }
  return Pose2{x->number_or(0), y->number_or(0), 0};
}

Result<RobotId> ScriptWorld::robot(Arguments arguments) const {
  RAVE_TRY(check_world());
  const std::string* const name = arguments.empty() ? nullptr : arguments.front().text();
  if (name == nullptr) {
    return fail(ErrorCode::kInvalidArgument, "expected the name of a robot, found {}",
                arguments.empty() ? "nothing" : script::kind_text(arguments.front()));
  }
  if (const auto found = ids_.find(*name); found != ids_.end()) return found->second;
  return fail(ErrorCode::kNotFound, "there is no robot `{}`{}", *name, nearest(*name));
}

script::Provided ScriptWorld::of_pose(std::string name, double (*part)(const Pose2&)) {
  return {std::move(name), [this, part](Arguments arguments) -> Result<Value> {
            RAVE_TRY_ASSIGN(const auto pose, place(arguments.empty() ? Value() : arguments[0]));
            return pose ? Value(part(*pose)) : Value();
          }};
}

script::Provided ScriptWorld::of_robot(std::string name,
                                       Value (*part)(const sim::WorldLook&, RobotId)) {
  return {std::move(name), [this, part](Arguments arguments) -> Result<Value> {
            RAVE_TRY_ASSIGN(const auto id, robot(arguments));
            return part(*world_, id);
          }};
}

Result<Value> ScriptWorld::distance(Arguments arguments) const {
  if (arguments.size() != 2) {
    return fail(ErrorCode::kInvalidArgument, "`distance`: expected two names or places");
  }
  RAVE_TRY_ASSIGN(const auto a, place(arguments[0]));
  RAVE_TRY_ASSIGN(const auto b, place(arguments[1]));
  // Far from everything: a condition such as `< 0.5` does not hold, and none fails.
  if (!a || !b) return Value(HUGE_VAL);
  const double dx = a->x - b->x;
  const double dy = a->y - b->y;
  return Value(std::sqrt(dx * dx + dy * dy));
}

// By step and draw, so that a manager that takes over in any step continues with the same numbers.
Value ScriptWorld::random() {
  constexpr std::uint32_t kOfTheScenario = 0xFFFF'FFFEU;
  RandomStream stream(seed_, kOfTheScenario, draws_++, static_cast<std::uint32_t>(world_->step()));
  return {stream.uniform()};
}

std::vector<script::Provided> ScriptWorld::functions() {
  std::vector<script::Provided> all = {
      of_pose("x", [](const Pose2& pose) { return pose.x; }),
      of_pose("y", [](const Pose2& pose) { return pose.y; }),
      of_pose("yaw_deg", [](const Pose2& pose) { return rad_to_deg(pose.yaw); }),
      of_robot("speed",
               [](const sim::WorldLook& world, RobotId id) { return Value(world.speed_mps(id)); }),
      of_robot("present", [](const sim::WorldLook& world,
                             RobotId id) { return Value(world.pose(id).has_value()); }),
      of_robot("touches",
               [](const sim::WorldLook& world, RobotId id) { return Value(world.touches(id)); })};
  all.push_back({"distance", [this](Arguments arguments) { return distance(arguments); }});
  all.push_back({"time", [this](Arguments) -> Result<Value> {
                   RAVE_TRY(check_world());
                   return Value(world_->now().seconds());
                 }});
  all.push_back({"random", [this](Arguments) -> Result<Value> {
                   RAVE_TRY(check_world());
                   return random();
                 }});
  all.push_back({"robots", [this](Arguments) -> Result<Value> {
                   Value::Table names;
                   for (std::size_t i = 0; i < robots_.size(); ++i) {
                     names.push_back({static_cast<std::int64_t>(i + 1), Value(robots_[i])});
                   }
                   return Value(std::move(names));
                 }});
  return all;
}

}  // namespace rave::runtime
