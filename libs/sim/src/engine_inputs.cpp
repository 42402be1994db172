// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>

#include "engine_impl.hpp"
#include "parameters.hpp"
#include "rave/base/check.hpp"
#include "rave/base/names.hpp"
#include "rave/world/touching.hpp"

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
    return fail(ErrorCode::kNotFound, "the robot has no {} of this number", part);
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
      return fail(ErrorCode::kInvalidArgument, "a real actuator takes no new parameters");
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
  return fail(ErrorCode::kInvalidArgument, "the body is no device");
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
  for (auto it = done.rbegin(); it != done.rend(); ++it) {
    static_cast<void>(it->target.update(it->target.present));
  }
}

}  // namespace

void Engine::Impl::note_input(RobotId robot, EventKind kind, std::string text, Author author) {
  if (author == Author::kHand) {
    text += text.empty() ? "by hand" : " (by hand)";
    ++by_hand;
  }
  ItemHash item(step, robot.value(), HashChannel::kInput, static_cast<std::uint32_t>(kind));
  item.add_bytes(std::as_bytes(std::span(text)));
  hash.add(item);
  pending.push_back({step, robot, kind, BodyId(), std::move(text)});
}

void Engine::Impl::make_changes() {
  for (; next_change < spec.changes.size() && spec.changes[next_change].step <= step;
       ++next_change) {
    const ScheduledChange& scheduled = spec.changes[next_change];
    const Status status = change(scheduled.robot, scheduled.changes, Author::kRun);
    if (status) continue;
    note_input(scheduled.robot, EventKind::kChangeRefused, status.error().text(), Author::kRun);
  }
}

Status Engine::Impl::change(RobotId robot, std::span<const ParameterChange> changes,
                            Author author) {
  RobotGroup& group = groups[group_index[robot.value()]];
  const std::size_t m = member_index[robot.value()];
  std::vector<Done> done;
  std::vector<std::pair<Part, std::uint32_t>> seen;
  const ParameterChange* scale = nullptr;
  const auto refuse = [&](const Error& error, std::string_view where) -> Status {
    undo(done);
    Error named = error;
    named.message =
        fmt::format("robot `{}`, {}: {}", spec.robots[robot.value()].name, where, error.message);
    return tl::unexpected(std::move(named));
  };
  for (const ParameterChange& first : changes) {
    if (first.part == Part::kBody) {
      const ParameterChange* const one[] = {&first};
      const auto checked = with_changes(body_params(), {}, one);
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
    const double before = scales.contains(robot.value()) ? scales[robot.value()] : 1.0;
    const double after = std::get<double>(scale->value);
    const Status status = resize(robot, after);
    if (!status) return refuse(status.error(), "body");
    text = fmt::format("body.scale: {} -> {}", before, after);
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
  if (scale != nullptr && group.program.spec != nullptr && group.program.failed[m] == 0) {
    // A program that keeps the radius of its robot learns the new one; one that takes no changes
    // goes on with what it believes.
    const auto target = program_target(group, m);
    if (target) static_cast<void>(target->update(target->present));
  }
  note_input(robot, EventKind::kChanged, std::move(text), author);
  return {};
}

Status Engine::Impl::resize(RobotId robot, double scale) {
  constexpr double kApart_m = 1e-4;  // the skin that the resolver keeps
  const std::uint32_t r = robot.value();
  if (!movers[r].simulated) {
    return fail(ErrorCode::kInvalidArgument, "a real body has the size that it has");
  }
  const auto original = original_bodies.find(r);
  RAVE_TRY_ASSIGN(
      const world::Body body,
      world::scaled(original != original_bodies.end() ? original->second : spec.world.robots[r],
                    scale));
  const auto own = static_cast<std::uint32_t>(spec.world.obstacles.size()) + r;
  for (std::uint32_t other = 0; other < spec.world.body_count(); ++other) {
    const std::uint32_t other_robot = other - (own - r);
    const bool is_robot = other >= own - r;
    if (other == own || (is_robot && !movers[other_robot].present)) continue;
    const Pose2 X_WB = is_robot ? movers[other_robot].X_WR : spec.world.obstacles[other].X_WB;
    const world::Body& theirs = spec.world.body(other);
    const double gap_m = world::separation(body, movers[r].X_WR, theirs, X_WB).distance_m;
    if (gap_m >= kApart_m) continue;
    const double before_m =
        world::separation(spec.world.robots[r], movers[r].X_WR, theirs, X_WB).distance_m;
    if (gap_m >= before_m) continue;
    return fail(ErrorCode::kInvalidArgument, "with `scale` {} it would overlap `{}`", scale,
                theirs.name.empty() && is_robot ? spec.robots[other_robot].name : theirs.name);
  }
  if (original == original_bodies.end()) original_bodies.emplace(r, spec.world.robots[r]);
  scales[r] = scale;
  put_body(robot, body);
  return {};
}

void Engine::Impl::put_body(RobotId robot, const world::Body& body) {
  const std::uint32_t r = robot.value();
  spec.world.robots[r] = body;
  radius_m[r] = body.radius_m();
  resolver.body_changed(r);
  snapshot.body_changed(robot);
  if (past) past->body_changed(robot);
  if (fusion_world) {
    fusion_world->world.body_changed(robot);
    fusion_world->valid = false;
  }
  RobotGroup& group = groups[group_index[r]];
  group.program.setups[member_index[r]].robot.radius_m = radius_m[r];
}

void Engine::Impl::restore_bodies() {
  for (const auto& [r, body] : original_bodies) put_body(RobotId(r), body);
  original_bodies.clear();
  scales.clear();
}

void Engine::stop(RobotId robot, Author author) {
  for (std::uint32_t r = 0; r < impl_->guard_states.size(); ++r) {
    if (robot.valid() && robot.value() != r) continue;
    if (impl_->guard_states[r].stopped) continue;
    impl_->guard_states[r].stopped = true;
    impl_->note_input(RobotId(r), EventKind::kStopped, "", author);
  }
}

void Engine::release(RobotId robot, Author author) {
  for (std::uint32_t r = 0; r < impl_->guard_states.size(); ++r) {
    if (robot.valid() && robot.value() != r) continue;
    GuardState& state = impl_->guard_states[r];
    if (!state.stopped) continue;
    state.stopped = false;
    const RobotType& type = impl_->spec.types[impl_->spec.robots[r].type];
    state.armed = type.simulated || !impl_->guards[impl_->spec.robots[r].type]->arm;
    impl_->note_input(RobotId(r), EventKind::kReleased, "", author);
  }
}

void Engine::arm(RobotId robot, Author author) {
  for (std::uint32_t r = 0; r < impl_->guard_states.size(); ++r) {
    if (robot.valid() && robot.value() != r) continue;
    if (impl_->guard_states[r].armed) continue;
    impl_->guard_states[r].armed = true;
    impl_->note_input(RobotId(r), EventKind::kArmed, "", author);
  }
}

bool Engine::stopped(RobotId robot) const noexcept {
  return impl_->guard_states[robot.value()].stopped;
}
bool Engine::armed(RobotId robot) const noexcept {
  return impl_->guard_states[robot.value()].armed;
}

Status Engine::set_parameters(RobotId robot, std::span<const ParameterChange> changes,
                              Author author) {
  RAVE_CHECK(robot.value() < impl_->spec.robots.size());
  if (changes.empty()) return fail(ErrorCode::kInvalidArgument, "nothing to change");
  return impl_->change(robot, changes, author);
}

std::string Engine::parameter(RobotId robot, ParameterChange::Part part, std::uint32_t index,
                              std::string_view name) const {
  if (part == Part::kBody) {
    if (name != "scale") return {};
    const auto scale = impl_->scales.find(robot.value());
    return fmt::format("{}", scale == impl_->scales.end() ? 1.0 : scale->second);
  }
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
  return impl_->radius_m[robot.value()];
}

}  // namespace rave::sim
