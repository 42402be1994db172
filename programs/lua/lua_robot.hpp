// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "rave/robot/program.hpp"
#include "rave/robot/scan.hpp"
#include "rave/script/script.hpp"

namespace rave::lua {

/// The functions by which a script asks and moves its robot. It must outlive the scripts that have
/// them. Used by the thread that decides.
class LuaRobot {
 public:
  LuaRobot() = default;
  LuaRobot(const LuaRobot&) = delete;
  LuaRobot& operator=(const LuaRobot&) = delete;

  void begin(const Setup& setup);
  /// What `param()` gives; a table.
  void set_params(script::Value params) { params_ = std::move(params); }
  [[nodiscard]] const script::Value& params() const noexcept { return params_; }
  [[nodiscard]] std::vector<script::Provided> functions();

  /// Between both calls there is a decision, and functions of percepts and commands work.
  void enter(const Percepts& percepts, Commands& commands);
  void leave() noexcept {
    percepts_ = nullptr;
    commands_ = nullptr;
  }

 private:
  using Arguments = std::span<const script::Value>;
  struct Sensor {
    std::uint32_t index = 0;
    const SensorInfo* info = nullptr;
  };

  [[nodiscard]] Status check_decision() const;
  [[nodiscard]] Result<Sensor> sensor(Arguments arguments) const;
  /// A function that works in decide() only.
  script::Provided in_decision(std::string name,
                               Result<script::Value> (LuaRobot::*function)(Arguments));
  void add_facts(std::vector<script::Provided>& all);

  Result<script::Value> reading(Arguments arguments);
  Result<script::Value> age(Arguments arguments);
  Result<script::Value> is_old(Arguments arguments);
  Result<script::Value> bearings(Arguments arguments);
  Result<script::Value> nearest(Arguments arguments);
  Result<script::Value> velocity(Arguments arguments);
  Result<script::Value> goal(Arguments arguments);
  Result<script::Value> say(Arguments arguments);
  Result<script::Value> done(Arguments arguments);
  Result<script::Value> send(Arguments arguments);
  Result<script::Value> messages(Arguments arguments);
  Result<script::Value> random(Arguments arguments);
  Result<script::Value> param(Arguments arguments) const;

  std::optional<Setup> setup_;
  Scan scan_;
  script::Value params_;
  const Percepts* percepts_ = nullptr;
  Commands* commands_ = nullptr;
  RandomStream random_{0, 0, 0, 0};
};

}  // namespace rave::lua
