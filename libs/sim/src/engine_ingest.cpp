// SPDX-License-Identifier: Apache-2.0
// The beginning of a step: hardware samples, the reported poses that follow from them, and the
// snapshot that all later phases read.
#include <algorithm>
#include <cstring>

#include "engine_impl.hpp"
#include "rave/math/finite.hpp"
#include "rave/math/transform.hpp"
#include "rave/sim/random_devices.hpp"

namespace rave::sim {
namespace {

/// Copies the records of a sample to a header and its records, behind those that are there or in
/// their place. What does not fit is counted.
void take_over(const SensorSlots& slots, const SampleHeader& sample, const std::byte* records,
               bool append, SampleHeader& header, std::byte* target) {
  const std::uint32_t size = record_size(slots.spec->kind);
  const std::uint32_t first = append ? header.count : 0;
  const std::uint32_t fitting = std::min(sample.count, slots.capacity - first);
  std::memcpy(target + std::size_t{first} * size, records, std::size_t{fitting} * size);
  header.stamp_ns = sample.stamp_ns;
  header.sequence = sample.sequence;
  header.count = first + fitting;
  header.dropped = (append ? header.dropped : 0) + sample.dropped + sample.count - fitting;
}

/// Random numbers for the processing of hardware samples: the sequence number stands for the
/// sample.
RandomStream processing_stream(const EngineSpec& spec, RobotId robot, std::uint32_t device,
                               std::uint32_t sequence) {
  // Drivers draw with `device` alone. The top bit keeps the noise of the robot file apart from
  // them, so that switching it on changes no other number.
  return {spec.seed, robot.value(), device | kProcessingDevice, sequence};
}

}  // namespace

PoseReading pose_reading(ReadingKind kind, const std::byte* record) {
  PoseReading reading;
  if (kind == ReadingKind::kPose) {
    std::memcpy(&reading, record, sizeof reading);
    return reading;
  }
  OdometryReading odometry;
  std::memcpy(&odometry, record, sizeof odometry);
  return {odometry.x_m, odometry.y_m, odometry.yaw_rad, odometry.variance_xy_m2,
          odometry.variance_yaw_rad2};
}

Status Engine::Impl::ingest() {
  RAVE_TRY(ingest_sensors(false));
  // The order is that of cause and effect: samples say where real robots are, these push simulated
  // robots away, the snapshot shows the result. No later phase of this step changes it.
  refresh_reported();
  truth.make_way();
  truth.note_contacts(step, events);
  show_world();
  // The virtual half of a hybrid needs the poses and the world up to this step.
  if (fusion_world) RAVE_TRY(ingest_sensors(true));
  return {};
}

Status Engine::Impl::ingest_sensors(bool hybrid) {
  for (RobotGroup& group : roster.groups) {
    for (SensorSlots& slots : group.sensors) {
      if (slots.is_virtual() || (slots.fusion != nullptr) != hybrid) continue;
      for (std::size_t m = 0; m < group.members.size(); ++m) {
        RAVE_TRY(ingest_sensor(group, slots, m));
      }
    }
  }
  return {};
}

Status Engine::Impl::ingest_sensor(RobotGroup& group, SensorSlots& slots, std::size_t member) {
  SampleQueue& queue = *slots.queues[member];
  const auto device = static_cast<std::uint32_t>(&slots - group.sensors.data());
  const RobotId robot = group.members[member];
  bool lost = slots.live;
  while (true) {
    // Stepped drivers promise what is complete; a full queue must be emptied before they can.
    const auto wait = slots.live || slots.failed[member] != 0
                          ? SampleQueue::Wait::kComplete
                          : queue.wait_complete(now, spec.host_timeout);
    SampleHeader sample;
    // All that has come since the last step, oldest first. A sample that fuse() withholds is not
    // delivered, but it counts as heard: its sensor is alive.
    while (queue.next(now, &sample, slots.scratch.data())) {
      if (queue.before().breaks != slots.before[member].breaks) note_break(group, slots, member);
      sample.sequence = ++slots.sequence[member];
      slots.heard_ns[member] = sample.stamp_ns;
      if (slots.fusion && !fuse(group, slots, member, sample)) continue;
      accept_hardware_sample(group, slots, member, sample);
    }
    // Stepped drivers lose nothing: the driver blocks on a full queue, so the room just made lets
    // it continue.
    if (wait == SampleQueue::Wait::kFull) continue;
    if (wait == SampleQueue::Wait::kTimeout) {
      return fail(ErrorCode::kTimeout,
                  "robot `{}`, sensor `{}` (driver `{}`) has not declared its samples complete up "
                  "to {:.3f} s for {} ms; the run cannot continue",
                  spec.robots[robot.value()].name, slots.spec->name, slots.spec->hardware_driver(),
                  now.seconds(), spec.host_timeout.count());
    }
    // A stepped driver runs ahead: what it says of its device counts when its samples have been
    // taken in, not when its thread happened to say it.
    lost = lost || wait == SampleQueue::Wait::kFailed;
    break;
  }
  if (lost) note_loss(slots, member, robot);
  note_refused(slots, member, robot);
  if (slots.processing) process_hardware_samples(group, slots, member);
  if (slots.headers[member].fresh == 2) {
    slots.headers[member].fresh = 1;
    // Once per step and sensor, after the last sample of the step. Intermediate states reach no
    // program and are not hashed.
    hash_delivery(group, slots, device, member, hash);
  }
  return {};
}

void Engine::Impl::note_loss(SensorSlots& slots, std::size_t member, RobotId robot) {
  const std::string failure = slots.queues[member]->failure();
  const bool failed = !failure.empty();
  if (failed == (slots.failed[member] != 0)) return;
  // What a stepped driver says of a loss is final, so only a live one can get here twice.
  slots.failed[member] = failed ? 1 : 0;
  note({step, robot, failed ? EventKind::kDriverFailed : EventKind::kDriverBack, BodyId(),
        fmt::format("sensor `{}`: {}", slots.spec->name, failed ? failure : "works again")});
}

void Engine::Impl::accept_hardware_sample(RobotGroup& group, SensorSlots& slots, std::size_t member,
                                          const SampleHeader& sample) {
  if (slots.processing) {
    // Events of one step go through the chain as one sample, states one by one.
    SampleHeader& raw = slots.raw_headers[member];
    if (raw.fresh != 0 && !slots.collect) push_hardware_sample(group, slots, member);
    take_over(slots, sample, slots.scratch.data(), raw.fresh != 0, raw,
              slots.raw_records_of(member));
    raw.fresh = 1;
    return;
  }
  SampleHeader& header = slots.headers[member];
  take_over(slots, sample, slots.scratch.data(), slots.collect && header.fresh != 0, header,
            slots.records_of(member));
  header.fresh = 2;  // arrived in this step; becomes 1 when the step's delivery is complete
  note_reported_pose(group, slots, member, sample, slots.scratch.data());
}

void Engine::Impl::push_hardware_sample(RobotGroup& group, SensorSlots& slots, std::size_t member) {
  SampleHeader& raw = slots.raw_headers[member];
  const auto device = static_cast<std::uint32_t>(&slots - group.sensors.data());
  slots.processing->push(raw, slots.raw_records_of(member),
                         processing_stream(spec, group.members[member], device, raw.sequence),
                         slots.processing_state_of(member));
  raw.fresh = 0;
}

void Engine::Impl::process_hardware_samples(RobotGroup& group, SensorSlots& slots,
                                            std::size_t member) {
  if (slots.raw_headers[member].fresh != 0) push_hardware_sample(group, slots, member);
  SampleHeader& header = slots.headers[member];
  std::byte* const state = slots.processing_state_of(member);
  std::byte* const scratch = slots.scratch.data();
  SampleHeader sample;
  // Of states the newest is enough; every event counts, even if several come due in one step.
  while (slots.collect ? slots.processing->deliver_oldest(now, state, &sample, scratch)
                       : slots.processing->deliver(now, state, &sample, scratch)) {
    take_over(slots, sample, scratch, slots.collect && header.fresh != 0, header,
              slots.records_of(member));
    header.fresh = 2;
    note_reported_pose(group, slots, member, sample, scratch);
  }
}

Pose2 Engine::Impl::pose_frame(const RobotGroup& group, RobotId robot) const {
  const SensorSpec& sensor = group.type->sensors[*group.type->pose_from];
  // Poses are those in the world. Odometry starts at zero where the robot was put, so its frame is
  // the start pose unless the file says otherwise.
  const Pose2 start = sensor.kind == ReadingKind::kPose ? Pose2{} : spec.robots[robot.value()].X_WR;
  return group.X_WM.value_or(group.type->X_WM.value_or(start));
}

void Engine::Impl::note_reported_pose(RobotGroup& group, const SensorSlots& slots,
                                      std::size_t member, const SampleHeader& header,
                                      const std::byte* record) {
  if (!group.is_pose_source(slots) || header.count == 0) return;
  const RobotId robot = group.members[member];
  const PoseReading reading = pose_reading(slots.spec->kind, record);
  const Pose2 X_WR = compose(pose_frame(group, robot), {reading.x_m, reading.y_m, reading.yaw_rad});
  // A pose that is not finite would spread to the grids and to every query near it.
  if (!is_finite(X_WR)) return;
  ReportedPose& pose = reported[robot.value()];
  pose.pose = {X_WR.x, X_WR.y, X_WR.yaw, reading.variance_xy_m2, reading.variance_yaw_rad2};
  pose.stamp = {header.stamp_ns};
  pose.known = true;
  const bool newer = tracks[robot.value()].add(pose.stamp, X_WR);
  // The authority and other hosts need each sample, not only the newest pose: their hybrid sensors
  // look up poses by stamp.
  if (host && newer && !group.type->simulated) {
    host->samples.push_back({robot, pose.stamp, X_WR});
  }
  pose.velocity = tracks[robot.value()].velocity();
}

void Engine::Impl::refresh_reported() {
  pool.for_each_block(roster.blocks.size(), refresh_effort, [this](std::size_t b, unsigned w) {
    const RobotGroup& group = roster.groups[roster.blocks[b].group];
    if (group.type->pose_from) {
      refresh_told(roster.blocks[b], workers[w]);
      return;
    }
    for (std::uint32_t m = roster.blocks[b].begin; m < roster.blocks[b].end; ++m) {
      refresh_true(group.members[m].value());
    }
  });
}

void Engine::Impl::refresh_true(std::uint32_t robot) {
  const Pose2& X_WR = truth.movers[robot].X_WR;
  // Number by number: a whole one would be put together elsewhere, and read back in larger parts
  // than it was written in, for which a processor waits.
  ReportedPose& told = reported[robot];
  told.pose.x_m = X_WR.x;
  told.pose.y_m = X_WR.y;
  told.pose.yaw_rad = X_WR.yaw;
  told.pose.variance_xy_m2 = 0;
  told.pose.variance_yaw_rad2 = 0;
  told.velocity = truth.velocity[robot];
  told.stamp = now;
  told.known = true;
  told.stale = false;
}

void Engine::Impl::refresh_told(const Block& block, Worker& worker) {
  const RobotGroup& group = roster.groups[block.group];
  for (std::uint32_t m = block.begin; m < block.end; ++m) {
    const RobotId robot = group.members[m];
    const std::uint32_t r = robot.value();
    ReportedPose& pose = reported[r];
    const bool stale = pose.known && now - pose.stamp > group.type->staleness;
    if (stale != pose.stale) {
      worker.events.push_back(
          {step, robot, stale ? EventKind::kPoseStale : EventKind::kPoseBack, BodyId(),
           stale ? fmt::format("its last pose is from {:.2f} s", pose.stamp.seconds())
                 : fmt::format("poses arrive again from {:.2f} s", pose.stamp.seconds())});
      pose.stale = stale;
    }
    // The velocity is an extrapolation of samples that are too old. Others would dodge a robot that
    // no longer moves.
    if (stale) pose.velocity = {};
    if (group.type->simulated) continue;
    truth.movers[r].X_WR = {pose.pose.x_m, pose.pose.y_m, pose.pose.yaw_rad};
    truth.movers[r].present = pose.known;
    truth.velocity[r] = pose.velocity;
  }
}

void Engine::Impl::show_world() {
  truth.show(now);
  remember();
}

void Engine::Impl::remember() {
  if (spec.history.ns <= 0) return;
  // One frame is added per step, so dropping one per step keeps the length. Frames are used again:
  // no allocation in steady state.
  if (!history.empty() && now - history.front().time > spec.history) history.drop_oldest();
  HistoryFrame& frame = history.add();
  frame.time = now;
  frame.robots.resize(truth.movers.size());
  for (std::uint32_t r = 0; r < truth.movers.size(); ++r)
    frame.robots[r] = truth.snapshot.robot(RobotId(r));
  frame.touch = truth.touch;
}

}  // namespace rave::sim
