// SPDX-License-Identifier: Apache-2.0
// Parameters of running parts. They are tried on the plug-in at once; until keep() is called, the
// end of an edit gives all parts their former values back.
#include "parameter_edit.hpp"

#include <algorithm>
#include <ranges>
#include <utility>

#include "parameters.hpp"

namespace rave::sim {
namespace {

using Part = ParameterChange::Part;

template <class Slots>
std::span<const ParamValue> present_values(const Slots& slots, std::size_t m) {
  return slots.changed[m] ? slots.changed[m]->values() : slots.spec->params.values();
}

Status updated(UpdateFunction update, void* instance, std::span<const ParamValue> values) {
  if (update == nullptr) {
    return fail(ErrorCode::kInvalidArgument, kTakesNoParameters);
  }
  ErrorText error;
  if (update(instance, values.data(), values.size(), &error) == 0) return {};
  return fail(ErrorCode::kInvalidArgument, "{}", error.text);
}

Result<ParameterTarget> program_target(RobotGroup& group, std::size_t m) {
  ProgramSlots& slots = group.program;
  if (slots.spec == nullptr) return fail(ErrorCode::kNotFound, "the robot has no program");
  if (slots.failed[m] != 0) return fail(ErrorCode::kState, "the program has failed");
  ParameterTarget target{
      "program", slots.spec->param_specs, present_values(slots, m), &slots.changed[m], {}};
  if (slots.spec->isolate) {
    // The process also learns the radius of the body, which it cannot see from where it is.
    target.update = [&slots, m](std::span<const ParamValue> values) {
      return slots.processes[m]->update(values, slots.setups[m].robot.radius_m);
    };
  } else {
    target.update = [&slots, m](std::span<const ParamValue> values) {
      return updated(slots.spec->ops->update, slots.instances.at(m), values);
    };
  }
  return target;
}

template <class Slots>
Result<ParameterTarget> device_target(std::vector<Slots>& devices, std::string_view part,
                                      std::uint32_t index, std::size_t m) {
  if (index >= devices.size()) {
    return fail(ErrorCode::kNotFound, "the robot has no {} with this number", part);
  }
  Slots& slots = devices[index];
  // A plug-in that failed is not called again.
  if (slots.failed[m] != 0) {
    return fail(ErrorCode::kState, "{} `{}` has failed", part, slots.spec->name);
  }
  ParameterTarget target;
  target.name = fmt::format("{}.{}", part, slots.spec->name);
  target.specs = slots.spec->param_specs;
  target.present = present_values(slots, m);
  target.changed = &slots.changed[m];
  return target;
}

Result<ParameterTarget> controller_target(RobotGroup& group, std::uint32_t index, std::size_t m) {
  RAVE_TRY_ASSIGN(ParameterTarget target, device_target(group.controllers, "controller", index, m));
  ControllerSlots& slots = group.controllers[index];
  target.update = [&slots, m](std::span<const ParamValue> values) {
    return updated(slots.spec->ops->update, slots.instances.at(m), values);
  };
  return target;
}

Result<ParameterTarget> actuator_target(RobotGroup& group, std::uint32_t index, std::size_t m) {
  RAVE_TRY_ASSIGN(ParameterTarget target, device_target(group.actuators, "actuator", index, m));
  ActuatorSlots& slots = group.actuators[index];
  target.update = [&slots, m](std::span<const ParamValue> values) -> Status {
    // A real actuator takes its parameters when it is opened.
    if (slots.spec->virtual_ops == nullptr) {
      return fail(ErrorCode::kInvalidArgument, "the parameters of a real actuator cannot change");
    }
    return updated(slots.spec->virtual_ops->update, slots.instances.at(m), values);
  };
  return target;
}

}  // namespace

Result<ParameterTarget> parameter_target(RobotGroup& group, std::size_t m, Part part,
                                         std::uint32_t index) {
  switch (part) {
    case Part::kProgram:
      return program_target(group, m);
    case Part::kController:
      return controller_target(group, index, m);
    case Part::kActuator:
      return actuator_target(group, index, m);
    case Part::kBody:
      break;
  }
  return fail(ErrorCode::kInvalidArgument, "the body is not a device");
}

std::optional<std::string> present_text(const ParameterTarget& target, std::string_view name) {
  for (const ParamSpec& spec : target.specs) {
    if (name != spec.name) continue;
    for (const ParamValue& value : target.present) {
      if (name == value.name) return value_text(spec, value);
    }
  }
  return std::nullopt;
}

namespace {

std::string change_text(const ParameterTarget& target,
                        std::span<const ParameterChange* const> changes) {
  std::string text;
  for (const ParameterChange* const change : changes) {
    const std::string before = present_text(target, change->name).value_or("?");
    text += fmt::format("{}{}.{}: {} -> {}", text.empty() ? "" : ", ", target.name, change->name,
                        before, to_string(change->value));
  }
  return text;
}

}  // namespace

// All changes of one part in one call, since a plug-in may accept only some combinations.
Status ParameterEdit::make(const ParameterChange& first, std::span<const ParameterChange> changes) {
  const std::pair key{first.part, first.index};
  if (std::find(seen_.begin(), seen_.end(), key) != seen_.end()) return {};
  seen_.push_back(key);
  std::vector<const ParameterChange*> together;
  for (const ParameterChange& other : changes) {
    if (other.part == first.part && other.index == first.index) together.push_back(&other);
  }
  where_ = "change";
  RAVE_TRY_ASSIGN(ParameterTarget target,
                  parameter_target(group_, member_, first.part, first.index));
  where_ = target.name;
  RAVE_TRY_ASSIGN(plugin::ParamSet next, with_changes(target.specs, target.present, together));
  // Before the update, while the old values can still be read.
  std::string text = change_text(target, together);
  RAVE_TRY(target.update(next.values()));
  made_.push_back({std::move(target), std::move(next), std::move(text)});
  return {};
}

std::string ParameterEdit::keep() {
  std::string text;
  for (Made& part : made_) {
    text += (text.empty() ? "" : ", ") + part.text;
    // What the setup of a program points to stays where it is until the next change.
    *part.target.changed = std::make_unique<plugin::ParamSet>(std::move(part.next));
    if (part.target.name != "program") continue;
    ProgramSetup& setup = group_.program.setups[member_];
    setup.params = group_.program.changed[member_]->values().data();
    setup.param_count = group_.program.changed[member_]->values().size();
  }
  made_.clear();
  return text;
}

ParameterEdit::~ParameterEdit() {
  // They had these values before, so a refusal now is not reported.
  for (Made& one : std::views::reverse(made_)) {
    static_cast<void>(one.target.update(one.target.present));
  }
}

}  // namespace rave::sim
