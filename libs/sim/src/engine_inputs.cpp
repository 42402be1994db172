// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>
#include <ranges>

#include "engine_impl.hpp"
#include "input_notes.hpp"
#include "parameters.hpp"
#include "rave/base/check.hpp"
#include "rave/base/names.hpp"

namespace rave::sim {
namespace {

using Part = ParameterChange::Part;

/// What a change of one program, controller or actuator needs.
struct Target {
  std::string name;  ///< As in a key: `controller.drive`.
  std::span<const ParamSpec> specs;
  std::span<const ParamValue> present;
  std::unique_ptr<plugin::ParamSet>* changed = nullptr;
  std::function<Status(std::span<const ParamValue>)> update;
};

template <class Slots>
std::span<const ParamValue> present_values(const Slots& slots, std::size_t m) {
  return slots.changed[m] ? slots.changed[m]->values() : slots.spec->params.values();
}

Status updated(UpdateFunction update, void* instance, std::span<const ParamValue> values) {
  if (update == nullptr) {
    return fail(ErrorCode::kInvalidArgument, "it takes no new parameters while it runs");
  }
  ErrorText error;
  if (update(instance, values.data(), values.size(), &error) == 0) return {};
  return fail(ErrorCode::kInvalidArgument, "{}", error.text);
}

Result<Target> program_target(RobotGroup& group, std::size_t m) {
  ProgramSlots& slots = group.program;
  if (slots.spec == nullptr) return fail(ErrorCode::kNotFound, "the robot has no program");
  if (slots.failed[m] != 0) return fail(ErrorCode::kState, "the program has failed");
  Target target{
      "program", slots.spec->param_specs, present_values(slots, m), &slots.changed[m], {}};
  if (slots.spec->isolate) {
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
Result<Target> device_target(std::vector<Slots>& devices, std::string_view part,
                             std::uint32_t index, std::size_t m) {
  if (index >= devices.size()) {
    return fail(ErrorCode::kNotFound, "the robot has no {} with this number", part);
  }
  Slots& slots = devices[index];
  if (slots.failed[m] != 0) {
    return fail(ErrorCode::kState, "{} `{}` has failed", part, slots.spec->name);
  }
  Target target;
  target.name = fmt::format("{}.{}", part, slots.spec->name);
  target.specs = slots.spec->param_specs;
  target.present = present_values(slots, m);
  target.changed = &slots.changed[m];
  return target;
}

Result<Target> controller_target(RobotGroup& group, std::uint32_t index, std::size_t m) {
  RAVE_TRY_ASSIGN(Target target, device_target(group.controllers, "controller", index, m));
  ControllerSlots& slots = group.controllers[index];
  target.update = [&slots, m](std::span<const ParamValue> values) {
    return updated(slots.spec->ops->update, slots.instances.at(m), values);
  };
  return target;
}

Result<Target> actuator_target(RobotGroup& group, std::uint32_t index, std::size_t m) {
  RAVE_TRY_ASSIGN(Target target, device_target(group.actuators, "actuator", index, m));
  ActuatorSlots& slots = group.actuators[index];
  target.update = [&slots, m](std::span<const ParamValue> values) -> Status {
    if (slots.spec->virtual_ops == nullptr) {
      return fail(ErrorCode::kInvalidArgument, "the parameters of a real actuator cannot change");
    }
    return updated(slots.spec->virtual_ops->update, slots.instances.at(m), values);
  };
  return target;
}

Result<Target> target_of(RobotGroup& group, std::size_t m, Part part, std::uint32_t index) {
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

/// What was done so far, to be undone if something later is refused.
struct Done {
  Target target;
  plugin::ParamSet next;
  std::string text;
};

std::string change_text(const Target& target, std::span<const ParameterChange* const> changes) {
  std::string text;
  for (const ParameterChange* const change : changes) {
    std::string before = "?";
    for (const ParamSpec& spec : target.specs) {
      if (change->name != spec.name) continue;
      for (const ParamValue& value : target.present) {
        if (change->name == value.name) before = value_text(spec, value);
      }
    }
    text += fmt::format("{}{}.{}: {} -> {}", text.empty() ? "" : ", ", target.name, change->name,
                        before, to_string(change->value));
  }
  return text;
}

void undo(std::vector<Done>& done) {
  for (Done& one : std::views::reverse(done)) {
    static_cast<void>(one.target.update(one.target.present));
  }
}

}  // namespace

void Engine::Impl::note_input(RobotId robot, EventKind kind, std::string text,
                              const Author& author) {
  if (author.by_hand) ++by_hand;
  pending.push_back(noted_input(step, robot, kind, std::move(text), author, hash));
}

void Engine::Impl::make_changes() {
  make_obstacle_changes();
  while (next_change < spec.changes.size() && spec.changes[next_change].step <= step) {
    make_change(spec.changes[next_change++]);
  }
}

void Engine::Impl::make_change(const ScheduledChange& scheduled) {
  const Status status = change(scheduled.robot, scheduled.changes, Author::kRun);
  if (status) return;
  note_input(scheduled.robot, EventKind::kChangeRefused, status.error().text(), Author::kRun);
}

Status Engine::Impl::change(RobotId robot, std::span<const ParameterChange> changes,
                            const Author& author) {
  RobotGroup& group = groups[group_index[robot.value()]];
  const std::size_t m = member_index[robot.value()];
  std::vector<Done> done;
  std::vector<std::pair<Part, std::uint32_t>> seen;
  const ParameterChange* scale = nullptr;
  const auto refuse = [&](const Error& error, std::string_view where) -> Status {
    undo(done);
    return refused_change(spec, robot, where, error);
  };
  for (const ParameterChange& first : changes) {
    if (first.part == Part::kBody) {
      Status checked = check_body_change(first);
      const Twin* const twin = find_twin(robot);
      if (checked && twin != nullptr && twin->state.under_way) {
        checked = fail(ErrorCode::kState, "it is being handed over");
      }
      if (!checked) return refuse(checked.error(), "body");
      scale = &first;
      continue;
    }
    const std::pair key{first.part, first.index};
    if (std::find(seen.begin(), seen.end(), key) != seen.end()) continue;
    seen.push_back(key);
    // All changes of one part at once: its parameters may depend on one another.
    std::vector<const ParameterChange*> together;
    for (const ParameterChange& other : changes) {
      if (other.part == first.part && other.index == first.index) together.push_back(&other);
    }
    auto target = target_of(group, m, first.part, first.index);
    if (!target) return refuse(target.error(), "change");
    auto next = with_changes(target->specs, target->present, together);
    if (!next) return refuse(next.error(), target->name);
    const std::string text = change_text(*target, together);
    const Status status = target->update(next->values());
    if (!status) return refuse(status.error(), target->name);
    done.push_back({*std::move(target), *std::move(next), text});
  }
  std::string text;
  if (scale != nullptr) {
    const double before = truth.scale_of(robot);
    const double after = std::get<double>(scale->value);
    const Status status = truth.resize(robot, after);
    if (!status) return refuse(status.error(), "body");
    body_changed(robot);
    text = body_change_text(before, after);
  }
  for (Done& part : done) {
    text += (text.empty() ? "" : ", ") + part.text;
    // What the setup of a program points to stays where it is until the next change.
    *part.target.changed = std::make_unique<plugin::ParamSet>(std::move(part.next));
    if (part.target.name != "program") continue;
    ProgramSetup& setup = group.program.setups[m];
    setup.params = group.program.changed[m]->values().data();
    setup.param_count = group.program.changed[m]->values().size();
  }
  if (scale != nullptr) tell_program_of_body(robot);
  note_input(robot, EventKind::kChanged, std::move(text), author);
  return {};
}

void Engine::Impl::body_changed(RobotId robot) {
  if (past) past->body_changed(robot);
  if (fusion_world) {
    fusion_world->world.body_changed(robot);
    fusion_world->valid = false;
  }
  if (!guard_bodies.empty()) guard_bodies[robot.value()].reset();
  if (!is_local(robot.value())) return;
  RobotGroup& group = groups[group_index[robot.value()]];
  group.program.setups[member_index[robot.value()]].robot.radius_m = truth.radius_m[robot.value()];
}

/// A program that keeps the radius of its robot learns the new one; one that takes no changes goes
/// on with what it believes.
void Engine::Impl::tell_program_of_body(RobotId robot) {
  if (!is_local(robot.value())) return;
  // Nobody listens if there is none, or if it has failed.
  const auto target =
      program_target(groups[group_index[robot.value()]], member_index[robot.value()]);
  if (target) static_cast<void>(target->update(target->present));
}

Result<ChangedObstacle> Engine::Impl::change_obstacle(const ObstacleChange& change,
                                                      const Author& author) {
  std::string note;
  RAVE_TRY_ASSIGN(const ObstacleChange made, truth.change_obstacle(change, step_time(step), note));
  obstacle_changed(made);
  if (author.by_hand) ++by_hand;
  pending.push_back(noted_obstacle(step, made, note, author, hash));
  return ChangedObstacle{made.id, step, pending.back().text};
}

void Engine::Impl::make_obstacle_changes() {
  for (; next_obstacle < spec.obstacle_changes.size() &&
         spec.obstacle_changes[next_obstacle].step <= step;
       ++next_obstacle) {
    const auto made = change_obstacle(spec.obstacle_changes[next_obstacle].change, Author::kRun);
    if (made) continue;
    note_input(RobotId(), EventKind::kChangeRefused, made.error().text(), Author::kRun);
  }
}

void Engine::Impl::obstacle_changed(const ObstacleChange& change) {
  // Where it was and is, they find in the journal.
  if (change.kind != ObstacleChange::Kind::kAdd) return;
  if (past) past->obstacle_added();
  if (fusion_world) fusion_world->world.obstacle_added();
}

void Engine::Impl::restore_obstacles() {
  if (!truth.restore_obstacles()) return;
  past.reset();
  if (fusion_world) fusion_world = std::make_unique<FusionWorld>(spec.world);
}

void Engine::Impl::restore_bodies() {
  for (const RobotId robot : truth.restore_bodies()) body_changed(robot);
}

void Engine::Impl::stop(RobotId robot, const Author& author) {
  for (std::uint32_t r = 0; r < robot_guards.size(); ++r) {
    if (!is_local(r) || (robot.valid() && robot.value() != r)) continue;
    if (!robot_guards[r].stop()) continue;
    // Not first in the next step, which may be long in coming.
    const RobotGroup& group = groups[group_index[r]];
    if (group.has_guard(member_index[r])) group.guards[member_index[r]].thread->stand();
    note_input(RobotId(r), EventKind::kStopped, "", author);
    if (!orders) continue;
    WorldInput cancel;
    cancel.author = author;
    static_cast<void>(end_orders(cancel, RobotId(r)));
  }
}

void Engine::Impl::release(RobotId robot, const Author& author) {
  for (std::uint32_t r = 0; r < robot_guards.size(); ++r) {
    if (!is_local(r) || (robot.valid() && robot.value() != r)) continue;
    if (!robot_guards[r].release(is_armed_at_first(r))) continue;
    note_input(RobotId(r), EventKind::kReleased, "", author);
  }
}

void Engine::Impl::arm(RobotId robot, const Author& author) {
  for (std::uint32_t r = 0; r < robot_guards.size(); ++r) {
    if (!is_local(r) || (robot.valid() && robot.value() != r)) continue;
    if (robot_guards[r].arm()) note_input(RobotId(r), EventKind::kArmed, "", author);
  }
}

void Engine::stop(RobotId robot, const Author& author) { impl_->stop(robot, author); }
void Engine::release(RobotId robot, const Author& author) { impl_->release(robot, author); }
void Engine::arm(RobotId robot, const Author& author) { impl_->arm(robot, author); }

bool Engine::stopped(RobotId robot) const noexcept {
  return impl_->robot_guards[robot.value()].holds().stopped;
}
bool Engine::armed(RobotId robot) const noexcept {
  return impl_->robot_guards[robot.value()].holds().armed;
}

Status Engine::Impl::check_own(RobotId robot, std::span<const ParameterChange> changes) const {
  const std::string& name = spec.robots[robot.value()].name;
  if (!is_local(robot.value())) {
    return fail(ErrorCode::kState, "robot `{}` runs on another host", name);
  }
  const auto is_of_body = [](const ParameterChange& one) { return one.part == Part::kBody; };
  if (std::none_of(changes.begin(), changes.end(), is_of_body)) return {};
  return fail(ErrorCode::kState, "only the authority can change the body of robot `{}`", name);
}

Status Engine::set_parameters(RobotId robot, std::span<const ParameterChange> changes,
                              const Author& author) {
  RAVE_CHECK(robot.value() < impl_->spec.robots.size());
  if (changes.empty()) return fail(ErrorCode::kInvalidArgument, "nothing to change");
  if (impl_->host) RAVE_TRY(impl_->check_own(robot, changes));
  return impl_->change(robot, changes, author);
}

Result<ChangedObstacle> Engine::change_obstacle(const ObstacleChange& change,
                                                const Author& author) {
  if (impl_->host) {
    return fail(ErrorCode::kState, "only the authority can change obstacles");
  }
  return impl_->change_obstacle(change, author);
}

std::string Engine::parameter(RobotId robot, ParameterChange::Part part, std::uint32_t index,
                              std::string_view name) const {
  if (part == Part::kBody) {
    if (name != "scale") return {};
    return fmt::format("{}", impl_->truth.scale_of(robot));
  }
  if (!is_local(robot)) return {};
  const auto target = target_of(impl_->groups[impl_->group_index[robot.value()]],
                                impl_->member_index[robot.value()], part, index);
  if (!target) return {};
  for (const ParamSpec& spec : target->specs) {
    if (name != spec.name) continue;
    for (const ParamValue& value : target->present) {
      if (name == value.name) return value_text(spec, value);
    }
  }
  return {};
}

std::uint64_t Engine::inputs_by_hand() const noexcept { return impl_->by_hand; }
void Engine::set_world_age(Duration age) noexcept { impl_->world_age = age; }
void Engine::halt() noexcept { impl_->halt(); }
double Engine::body_radius_m(RobotId robot) const noexcept {
  return impl_->truth.radius_m[robot.value()];
}

}  // namespace rave::sim
