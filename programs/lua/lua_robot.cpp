// SPDX-License-Identifier: Apache-2.0
#include "lua_robot.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "lua_values.hpp"
#include "rave/base/names.hpp"
#include "rave/math/scalar.hpp"

namespace rave::lua {
namespace {

using script::Value;
using Arguments = std::span<const Value>;

/// What a sensor of any kind is looked up by.
using AnyHandle = SensorHandle<std::byte>;

/// The number at `place`, counted from 0.
Result<double> number(Arguments arguments, std::size_t place, const char* function,
                      std::optional<double> otherwise = {}) {
  if (place >= arguments.size() || arguments[place].is_nil()) {
    if (otherwise) return *otherwise;
  } else if (const double value = arguments[place].number_or(NAN); std::isfinite(value)) {
    return value;
  }
  return fail(ErrorCode::kInvalidArgument,
              "`{}`: expected a finite number as argument {}, found {}", function, place + 1,
              place < arguments.size() ? script::to_text(arguments[place]) : "nothing");
}

Result<std::string> text(Arguments arguments, const char* function) {
  if (!arguments.empty()) {
    if (const std::string* const found = arguments.front().text()) return *found;
    if (const double value = arguments.front().number_or(NAN); !std::isnan(value)) {
      return script::to_text(arguments.front());
    }
  }
  return fail(ErrorCode::kInvalidArgument, "`{}`: expected a text, found {}", function,
              arguments.empty() ? "nothing" : script::kind_text(arguments.front()));
}

}  // namespace

void LuaRobot::begin(const Setup& setup) {
  setup_ = setup;
  scan_ = Scan(setup);
}

void LuaRobot::enter(const Percepts& percepts, Commands& commands) {
  percepts_ = &percepts;
  commands_ = &commands;
  random_ = percepts.random();
  scan_.update(percepts);
}

Status LuaRobot::check_decision() const {
  if (percepts_ != nullptr) return {};
  return fail(ErrorCode::kState, "there are no readings and commands yet; ask in decide()");
}

Result<LuaRobot::Sensor> LuaRobot::sensor(Arguments arguments) const {
  RAVE_TRY_ASSIGN(const std::string name, text(arguments, "sensor"));
  const std::span<const SensorInfo> all = setup_->sensors();
  std::vector<std::string_view> names;
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    if (name == all[i].name) return Sensor{i, &all[i]};
    names.emplace_back(all[i].name);
  }
  return fail(ErrorCode::kNotFound, "the robot has no sensor `{}`{}", name,
              suggestion(name, names));
}

Result<Value> LuaRobot::reading(Arguments arguments) {
  RAVE_TRY_ASSIGN(const Sensor found, sensor(arguments));
  const AnyHandle handle(found.index, found.info);
  return sample_value(found.info->kind, percepts_->header(handle).count,
                      (*percepts_)[handle].data());
}

Result<Value> LuaRobot::age(Arguments arguments) {
  RAVE_TRY_ASSIGN(const Sensor found, sensor(arguments));
  return Value(percepts_->age_s(AnyHandle(found.index, found.info)));
}

Result<Value> LuaRobot::is_old(Arguments arguments) {
  if (arguments.empty()) return Value(scan_.is_old());
  RAVE_TRY_ASSIGN(const Sensor found, sensor(arguments));
  return Value(percepts_->is_old(AnyHandle(found.index, found.info)));
}

Result<Value> LuaRobot::bearings(Arguments arguments) {
  RAVE_TRY_ASSIGN(const Sensor found, sensor(arguments));
  if (found.info->bearings_rad == nullptr) {
    return fail(ErrorCode::kInvalidArgument, "`bearings`: sensor `{}` gives {}, not ranges",
                found.info->name, to_string(found.info->kind));
  }
  Value::Table list;
  for (std::uint32_t i = 0; i < found.info->capacity; ++i) {
    list.push_back(
        {std::int64_t{i} + 1, wrap_angle(found.info->X_RS.yaw + found.info->bearings_rad[i])});
  }
  return Value(std::move(list));
}

Result<Value> LuaRobot::nearest(Arguments arguments) {
  RAVE_TRY_ASSIGN(const double from_deg, number(arguments, 0, "nearest", -180));
  RAVE_TRY_ASSIGN(const double to_deg, number(arguments, 1, "nearest", 180));
  return Value(scan_.nearest_m(deg_to_rad(from_deg), deg_to_rad(to_deg)));
}

Result<Value> LuaRobot::velocity(Arguments arguments) {
  RAVE_TRY_ASSIGN(const double v_mps, number(arguments, 0, "velocity"));
  RAVE_TRY_ASSIGN(const double w_radps, number(arguments, 1, "velocity", 0));
  RAVE_TRY_ASSIGN(const double vy_mps, number(arguments, 2, "velocity", 0));
  RAVE_TRY_ASSIGN(const ControllerHandle drive, setup_->controller(CommandKind::kVelocity));
  commands_->velocity(drive, v_mps, w_radps, vy_mps);
  return Value();
}

Result<Value> LuaRobot::goal(Arguments arguments) {
  RAVE_TRY_ASSIGN(const double x_m, number(arguments, 0, "goal"));
  RAVE_TRY_ASSIGN(const double y_m, number(arguments, 1, "goal"));
  RAVE_TRY_ASSIGN(const double speed_mps, number(arguments, 2, "goal", 0));
  RAVE_TRY_ASSIGN(const ControllerHandle go, setup_->controller(CommandKind::kGoal));
  commands_->goal(go, {x_m, y_m}, speed_mps);
  return Value();
}

Result<Value> LuaRobot::say(Arguments arguments) {
  RAVE_TRY_ASSIGN(const std::string said, text(arguments, "say"));
  return Value(commands_->say(said));
}

Result<Value> LuaRobot::done(Arguments arguments) {
  RAVE_TRY_ASSIGN(const std::string said, text(arguments, "done"));
  return Value(commands_->done(said));
}

Result<Value> LuaRobot::send(Arguments arguments) {
  RAVE_TRY_ASSIGN(const std::string words, text(arguments, "send"));
  RAVE_TRY_ASSIGN(const CommunicatorHandle radio, setup_->communicator());
  Recipient to = Recipient::everyone();
  if (arguments.size() > 1) {
    RAVE_TRY_ASSIGN(const std::string name, text(arguments.subspan(1), "send"));
    RAVE_TRY_ASSIGN(const std::uint32_t robot, setup_->robot_id(name));
    to = Recipient::one(robot);
  }
  return Value(commands_->send(radio, std::as_bytes(std::span(words.data(), words.size())), to));
}

Result<Value> LuaRobot::messages(Arguments /*arguments*/) {
  RAVE_TRY_ASSIGN(const CommunicatorHandle radio, setup_->communicator());
  Value::Table list;
  for (const Message message : percepts_->messages(radio)) {
    const auto next = static_cast<std::int64_t>(list.size()) + 1;
    list.push_back({next, message_value(message)});
  }
  return Value(std::move(list));
}

/// As math.random of Lua: in [0, 1), or a whole number from 1 or `a` to the last argument.
Result<Value> LuaRobot::random(Arguments arguments) {
  const double share = random_.uniform();
  if (arguments.empty()) return Value(share);
  double low = 1;
  if (arguments.size() > 1) {
    RAVE_TRY_ASSIGN(low, number(arguments, 0, "random"));
  }
  RAVE_TRY_ASSIGN(const double high, number(arguments, arguments.size() > 1 ? 1 : 0, "random"));
  constexpr double kMost = 1e15;
  if (low > high || std::abs(low) > kMost || std::abs(high) > kMost) {
    return fail(ErrorCode::kInvalidArgument, "`random`: from {} to {} is no range", low, high);
  }
  const double whole = std::floor(low + share * (high - low + 1));
  return Value(static_cast<std::int64_t>(std::min(whole, high)));
}

Result<Value> LuaRobot::param(Arguments arguments) const {
  RAVE_TRY_ASSIGN(const std::string name, text(arguments, "param"));
  if (const Value* const found = params_.find(name)) return *found;
  if (arguments.size() > 1) return arguments[1];
  return fail(ErrorCode::kNotFound,
              "there is no parameter `{}`; give it in `with` of the robot file, or a default: "
              "param(\"{}\", 1)",
              name, name);
}

script::Provided LuaRobot::in_decision(std::string name,
                                       Result<Value> (LuaRobot::*function)(Arguments)) {
  return {std::move(name), [this, function](Arguments arguments) -> Result<Value> {
            RAVE_TRY(check_decision());
            return (this->*function)(arguments);
          }};
}

void LuaRobot::add_facts(std::vector<script::Provided>& all) {
  all.push_back(
      {"param", [this](Arguments arguments) -> Result<Value> { return param(arguments); }});
  all.push_back({"log", [this](Arguments arguments) -> Result<Value> {
                   RAVE_TRY_ASSIGN(const std::string line, text(arguments, "log"));
                   setup_->log(line);
                   return Value();
                 }});
  all.push_back({"robot_name", [this](Arguments) -> Result<Value> {
                   return Value(std::string(setup_->robot_name()));
                 }});
  all.push_back({"robot_id", [this](Arguments arguments) -> Result<Value> {
                   if (arguments.empty()) return Value(std::int64_t{setup_->own_id()});
                   RAVE_TRY_ASSIGN(const std::string name, text(arguments, "robot_id"));
                   RAVE_TRY_ASSIGN(const std::uint32_t id, setup_->robot_id(name));
                   return Value(std::int64_t{id});
                 }});
  all.push_back(
      {"radius", [this](Arguments) -> Result<Value> { return Value(setup_->robot_radius_m()); }});
  all.push_back(
      {"period", [this](Arguments) -> Result<Value> { return Value(setup_->period_s()); }});
}

std::vector<script::Provided> LuaRobot::functions() {
  std::vector<script::Provided> all;
  add_facts(all);
  all.push_back({"time", [this](Arguments) -> Result<Value> {
                   RAVE_TRY(check_decision());
                   return Value(percepts_->now().seconds());
                 }});
  all.push_back({"pose", [this](Arguments) -> Result<Value> {
                   RAVE_TRY(check_decision());
                   return pose_value(percepts_->pose());
                 }});
  all.push_back(in_decision("reading", &LuaRobot::reading));
  all.push_back(in_decision("age", &LuaRobot::age));
  all.push_back(in_decision("is_old", &LuaRobot::is_old));
  all.push_back(in_decision("bearings", &LuaRobot::bearings));
  all.push_back(in_decision("nearest", &LuaRobot::nearest));
  all.push_back(in_decision("velocity", &LuaRobot::velocity));
  all.push_back(in_decision("goal", &LuaRobot::goal));
  all.push_back(in_decision("say", &LuaRobot::say));
  all.push_back(in_decision("done", &LuaRobot::done));
  all.push_back(in_decision("send", &LuaRobot::send));
  all.push_back(in_decision("messages", &LuaRobot::messages));
  all.push_back(in_decision("math.random", &LuaRobot::random));
  return all;
}

}  // namespace rave::lua
