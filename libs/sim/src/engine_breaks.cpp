// SPDX-License-Identifier: Apache-2.0
// Samples of hardware that were not believed, and such that do not continue those before: the clock
// of the device was set, another sender took its place, the robot was carried away.
#include "engine_impl.hpp"

namespace rave::sim {

void Engine::Impl::note_break(RobotGroup& group, SensorSlots& slots, std::size_t member) {
  const SampleQueue& queue = *slots.queues[member];
  slots.before[member].breaks = queue.before().breaks;
  const RobotId robot = group.members[member];
  if (group.is_pose_source(slots)) {
    // The velocity would otherwise be estimated across the break.
    tracks[robot.value()].clear();
    if (slots.processing) slots.processing->reset(slots.processing_state_of(member));
  }
  const std::string text = fmt::format("sensor `{}`: {}", slots.spec->name, queue.break_reason());
  // Who armed it did so for what its sensors had said.
  const bool drives = !group.type->simulated && group.obeys(member) && group.relies_on(slots);
  const bool disarmed = drives && robot_guards[robot.value()].disarm();
  note(
      {step, robot, disarmed ? EventKind::kDisarmed : EventKind::kSensorRestarted, BodyId(), text});
}

void Engine::Impl::note_refused(SensorSlots& slots, std::size_t member, RobotId robot) {
  const SampleQueue& queue = *slots.queues[member];
  // A stepped driver runs ahead: what was refused counts when the sample after it does.
  const std::uint64_t refused = (slots.live ? queue.latest() : queue.before()).refused;
  if (refused == slots.before[member].refused) return;
  slots.before[member].refused = refused;
  const auto present = static_cast<std::int64_t>(step);
  const auto quiet_steps = static_cast<std::int64_t>(kGuardQuiet_s / spec.step.seconds());
  const bool begins = present - slots.refused_step[member] > quiet_steps;
  slots.refused_step[member] = present;
  if (!begins) return;
  note({step, robot, EventKind::kPoseRefused, BodyId(),
        fmt::format("sensor `{}`: {}", slots.spec->name, queue.refusal())});
}

}  // namespace rave::sim
