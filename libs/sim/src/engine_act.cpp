// SPDX-License-Identifier: Apache-2.0
// The act phase: commands go through controllers and guards to actuators. Virtual actuators propose
// velocities, which the resolver limits later; hardware is written to at the end of the phase, or
// by the threads of its guards.
#include <algorithm>
#include <cmath>

#include "engine_impl.hpp"
#include "rave/math/finite.hpp"
#include "rave/sim/random_devices.hpp"

namespace rave::sim {
namespace {

/// One text is kept per batch: that of the last one to fail.
std::string_view text_for(const ErrorText& error, std::size_t slot) noexcept {
  return error.slot == slot ? std::string_view(error.text) : "failed, like others in this step";
}

/// What the proposals of an actuator are for.
struct Proposals {
  std::uint64_t step;
  const std::vector<RobotId>& members;
  std::vector<Twist2>& by_robot;
};

/// A virtual actuator proposes velocities for the inputs that actuate() has left in the worker.
void propose_motion(ActuatorSlots& slots, const Block& block, Worker& worker,
                    const Proposals& made) {
  ErrorText error;
  std::uint8_t failed_before[kMemberBlock];
  std::copy(slots.failed.begin() + block.begin, slots.failed.begin() + block.end, failed_before);
  slots.spec->virtual_ops->propose(
      slots.instances.at(block.begin), slots.instances.stride(), worker.motion_inputs.data(),
      worker.proposals.data(), block.end - block.begin, slots.failed.data() + block.begin, &error);
  for (std::uint32_t m = block.begin; m < block.end; ++m) {
    Twist2 twist = worker.proposals[m - block.begin];
    std::string_view problem = text_for(error, m - block.begin);
    if (slots.failed[m] == 0 && !is_finite(twist)) {
      slots.failed[m] = 1;
      problem = "proposed a velocity that is not finite";
    }
    if (slots.failed[m] != 0) {
      twist = {};
      if (failed_before[m - block.begin] == 0) {
        worker.events.push_back({made.step, made.members[m], EventKind::kDriverFailed, BodyId(),
                                 fmt::format("actuator `{}`: {}", slots.spec->name, problem)});
      }
    }
    made.by_robot[made.members[m].value()] = twist;
  }
}

}  // namespace

void Engine::Impl::act() {
  if (!orders.empty()) orders.steer(order_moment());
  pool.for_each_block(roster.blocks.size(), act_effort, [this](std::size_t b, unsigned w) {
    act_block(roster.blocks[b], workers[w]);
  });
  // Hardware is written to from one thread, in the order of the robots, or by their guards.
  for (RobotGroup& group : roster.groups) {
    for (std::uint32_t m = 0; m < group.guards.size(); ++m) {
      if (group.has_guard(m)) serve_guard(group, m);
    }
    for (ActuatorSlots& slots : group.actuators) {
      if (slots.spec->hardware_ops == nullptr) continue;
      for (std::size_t m = 0; m < group.members.size(); ++m) {
        if (!group.has_guard(m)) write_hardware(group, slots, m);
      }
    }
  }
}

void Engine::Impl::write_hardware(RobotGroup& group, ActuatorSlots& slots, std::size_t member) {
  if (slots.commands[member].kind == CommandKind::kNone) return;
  ErrorText error;
  const CrashNote whose =
      crash_note(group.members[member], group.members[member], "actuator", slots.spec->driver);
  const CrashScope scope(whose);
  const bool failed = slots.spec->hardware_ops->write(slots.instances.at(member),
                                                      &slots.commands[member], now.ns, &error) != 0;
  note_written(group, slots, member, failed, error.text);
}

/// A device that is gone may come back, so it still gets commands, and both are logged once.
void Engine::Impl::note_written(const RobotGroup& group, ActuatorSlots& slots, std::size_t member,
                                bool failed, std::string_view text) {
  if (failed == (slots.failed[member] != 0)) return;
  slots.failed[member] = failed ? 1 : 0;
  slots.trouble[member] = failed ? text : "";
  note({step, group.members[member], failed ? EventKind::kDriverFailed : EventKind::kDriverBack,
        BodyId(),
        fmt::format("actuator `{}`: {}", slots.spec->name, failed ? text : "works again")});
}

void Engine::Impl::act_block(const Block& block, Worker& worker) {
  RobotGroup& group = roster.groups[block.group];
  control(group, block, worker);
  actuate(group, block, worker);
}

// Commands stay in the memory of the worker until actuate(), which runs in the same call. Each
// controller is called once per block, so the cost of crossing into the plug-in is shared by its
// robots.
void Engine::Impl::control(RobotGroup& group, const Block& block, Worker& worker) {
  const std::uint32_t count = block.end - block.begin;
  worker.control_outputs.resize(std::max(worker.control_outputs.size(), group.controllers.size()));
  for (std::size_t c = 0; c < group.controllers.size(); ++c) {
    ControllerSlots& slots = group.controllers[c];
    std::array<Command, kMemberBlock>& outputs = worker.control_outputs[c];
    for (std::uint32_t m = block.begin; m < block.end; ++m) {
      const ReportedPose& pose = reported[group.members[m].value()];
      ControlInput& input = worker.control_inputs[m - block.begin];
      input.command = slots.last[m];
      // Before the first command, `command` is kNone, and nothing can be too old.
      input.command_age_s =
          slots.last_step[m] < 0
              ? 0
              : (Duration{spec.step.ns * (static_cast<std::int64_t>(step) - slots.last_step[m])})
                    .seconds();
      input.pose = pose.pose;
      input.velocity = pose.velocity;
      input.dt_s = spec.step.seconds();
    }
    // The plug-in sets the marks of those that failed and never clears one. The difference tells
    // who failed in this call, and so for whom there is an event.
    std::uint8_t failed_before[kMemberBlock];
    std::copy(slots.failed.begin() + block.begin, slots.failed.begin() + block.end, failed_before);
    ErrorText error;
    const CrashNote whose = crash_note(block, "controller", slots.spec->driver);
    const CrashScope scope(whose);
    slots.spec->ops->control(slots.instances.at(block.begin), slots.instances.stride(),
                             worker.control_inputs.data(), outputs.data(), count,
                             slots.failed.data() + block.begin, &error);
    for (std::uint32_t m = block.begin; m < block.end; ++m) {
      std::string_view problem = text_for(error, m - block.begin);
      Command& output = outputs[m - block.begin];
      if (slots.failed[m] == 0 && !is_finite(output.value)) {
        slots.failed[m] = 1;
        problem = "gave a command that is not finite";
      }
      if (slots.failed[m] == 0) continue;
      // A failed controller gives zeros until a reset: a plug-in that threw once has an unknown
      // state.
      output = {slots.spec->ops->gives, 0, {}};
      if (failed_before[m - block.begin] != 0) continue;
      worker.events.push_back({step, group.members[m], EventKind::kDriverFailed, BodyId(),
                               fmt::format("controller `{}`: {}", slots.spec->name, problem)});
    }
  }
}

void Engine::Impl::actuate(RobotGroup& group, const Block& block, Worker& worker) {
  const double dt_s = spec.step.seconds();
  const bool has_guards = !group.guards.empty();
  for (std::uint32_t a = 0; a < group.actuators.size(); ++a) {
    ActuatorSlots& slots = group.actuators[a];
    for (std::uint32_t m = block.begin; m < block.end; ++m) {
      const ControllerSlots* const active = group.speaker(a, m);
      const Command* const given =
          active != nullptr ? &worker.control_outputs[group.index_of(*active)][m - block.begin]
                            : nullptr;
      const std::uint32_t r = group.members[m].value();
      if (has_guards && group.has_guard(m)) {
        // Goes to the guard as it is, which limits it when it writes.
        slots.commands[m] = given != nullptr ? *given : Command{};
      } else if (active != nullptr && is_unguarded(slots, m, r)) {
        slots.commands[m] = *given;
      } else {
        slots.commands[m] =
            guarded(group, slots, m, active, given != nullptr ? *given : Command{}, worker);
      }
      if (slots.spec->virtual_ops == nullptr) continue;
      MotionInput& input = worker.motion_inputs[m - block.begin];
      input.command = slots.commands[m];
      input.velocity = truth.velocity[r];
      input.dt_s = dt_s;
      input.seed = spec.seed;
      input.robot = r;
      input.device = a | kActuatorDevice;
      input.step = static_cast<std::uint32_t>(step);
      // Velocity and contact are those of the last step, because the motion of this one is not
      // resolved before all robots have proposed.
      input.contact = truth.limited[r];
    }
    if (slots.spec->virtual_ops == nullptr) continue;
    const CrashNote whose = crash_note(block, "actuator", slots.spec->driver);
    const CrashScope scope(whose);
    propose_motion(slots, block, worker, {step, group.members, truth.proposal});
  }
}

/// The end of a step: what threads gathered, put together.
void Engine::Impl::publish() {
  for (Worker& worker : workers) {
    // The hash is a sum, so the order of the threads does not matter. Events are sorted afterwards.
    hash.merge(worker.hash);
    worker.hash = RunHash();
    for (Event& event : worker.events) events.push_back(std::move(event));
    worker.events.clear();
  }
  finish_events(step, events, hash);
}

}  // namespace rave::sim
