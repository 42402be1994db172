// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rave/plugin/param_set.hpp"
#include "rave/sim/parameter_change.hpp"
#include "robot_group.hpp"

namespace rave::sim {

/// The program, a controller or an actuator of one robot, as far as its parameters go.
struct ParameterTarget {
  std::string name;  ///< As in a key: `controller.drive`.
  std::span<const ParamSpec> specs;
  std::span<const ParamValue> present;
  std::unique_ptr<plugin::ParamSet>* changed = nullptr;
  std::function<Status(std::span<const ParamValue>)> update;
};

/// Errors: kNotFound (the robot has none), kState (it has failed), kInvalidArgument (the body).
[[nodiscard]] Result<ParameterTarget> parameter_target(RobotGroup& group, std::size_t member,
                                                       ParameterChange::Part part,
                                                       std::uint32_t index);
/// The present value of a parameter, as a person would write it; nothing if there is none of
/// the name.
[[nodiscard]] std::optional<std::string> present_text(const ParameterTarget& target,
                                                      std::string_view name);

/// A change of parameters of one robot: drivers and program are asked one after the other, and if
/// one of them refuses, those before it are given back what they had. Belongs to one thread.
class ParameterEdit {
 public:
  ParameterEdit(RobotGroup& group, std::size_t member) : group_(group), member_(member) {}
  ParameterEdit(const ParameterEdit&) = delete;
  ParameterEdit& operator=(const ParameterEdit&) = delete;
  /// Undoes what was not kept.
  ~ParameterEdit();

  /// Makes all changes of the part that `first` is of: its parameters may depend on one another.
  /// Nothing if they are made already. Errors: what the part says, and parameter_target().
  Status make(const ParameterChange& first, std::span<const ParameterChange> changes);
  /// Where the last error was, as in a key.
  [[nodiscard]] const std::string& where() const noexcept { return where_; }
  /// What was changed holds from now on. Returns it for people: `program.v: 0.2 -> 0.4, ...`.
  [[nodiscard]] std::string keep();

 private:
  struct Made {
    ParameterTarget target;
    plugin::ParamSet next;
    std::string text;
  };

  RobotGroup& group_;
  std::size_t member_;
  std::vector<std::pair<ParameterChange::Part, std::uint32_t>> seen_;
  std::vector<Made> made_;
  std::string where_;
};

}  // namespace rave::sim
