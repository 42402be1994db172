// SPDX-License-Identifier: Apache-2.0
// Where robots were, and what a sensor would have read there.
#include <algorithm>

#include "engine_impl.hpp"
#include "plugin_call.hpp"
#include "rave/math/transform.hpp"

namespace rave::sim {

/// Adds to the poses of `past` what is not interpolated, from the last frame up to `stamp`.
void Engine::Impl::look_back(SimTime stamp) {
  const HistoryFrame* frame = nullptr;
  // From the newest backward: who looks back mostly asks about the last steps.
  for (std::size_t i = history.size(); i > 0 && frame == nullptr; --i) {
    if (history[i - 1].time <= stamp) frame = &history[i - 1];
  }
  for (std::uint32_t r = 0; frame != nullptr && r < truth.movers.size(); ++r) {
    world::RobotState state = past.world->robot(RobotId(r));
    state.velocity_W = frame->robots[r].velocity_W;
    past.world->set_robot(RobotId(r), state);
    past.world->set_touch(RobotId(r), frame->touch[r]);
  }
  truth.journal.show(*past.world, past.obstacles, truth.journal.revision_at(stamp));
  past.world->set_time(stamp);
  past.world->rebuild();
  past.valid = true;
}

Result<Pose2> Engine::pose_at(RobotId robot, SimTime stamp) const {
  const Impl& engine = *impl_;
  const std::uint32_t r = robot.value();
  std::optional<Pose2> pose;
  if (stamp > engine.truth.snapshot.time()) {
    // Where a robot will be is not known, even if nothing newer than its last pose is.
  } else if (!engine.truth.movers[r].simulated) {
    pose = engine.tracks[r].at(stamp);
  } else if (!engine.history.empty() && stamp >= engine.history.front().time &&
             stamp <= engine.history.back().time) {
    std::size_t i = engine.history.size() - 1;
    while (i > 0 && engine.history[i].time > stamp) --i;
    const HistoryFrame& a = engine.history[i];
    pose = a.robots[r].X_WR;
    if (i + 1 < engine.history.size()) {
      const HistoryFrame& b = engine.history[i + 1];
      const double s =
          static_cast<double>((stamp - a.time).ns) / static_cast<double>((b.time - a.time).ns);
      pose = interpolate(a.robots[r].X_WR, b.robots[r].X_WR, s);
    }
  }
  if (pose) return *pose;
  return fail(ErrorCode::kInvalidArgument, "robot `{}` has no pose at {:.3f} s in the history",
              engine.spec.robots[r].name, stamp.seconds());
}

Result<SampleHeader> Engine::sample_at(RobotId robot, std::uint32_t sensor, SimTime stamp,
                                       void* records) {
  Impl& engine = *impl_;
  if (!is_local(robot)) {
    return fail(ErrorCode::kInvalidArgument, "robot `{}` runs on another host",
                engine.spec.robots[robot.value()].name);
  }
  RobotGroup& group = engine.roster.group_of(robot);
  SensorSlots& slots = group.sensors[sensor];
  if (!slots.is_virtual()) {
    return fail(ErrorCode::kInvalidArgument, "sensor `{}` is not virtual", slots.spec->name);
  }
  RAVE_TRY_ASSIGN(const Pose2 X_WR, pose_at(robot, stamp));
  if (!engine.past.world) {
    engine.past.world = std::make_unique<world::Snapshot>(engine.spec.world);
    engine.past.obstacles = engine.truth.journal.revision();
  }
  // Several sensors are asked about the same moment, so the world of the last question is kept.
  if (!engine.past.valid || engine.past.world->time() != stamp) {
    for (std::uint32_t r = 0; r < engine.truth.movers.size(); ++r) {
      const auto pose = pose_at(RobotId(r), stamp);
      engine.past.world->set_robot(RobotId(r), {pose.value_or(Pose2{}), {}, pose.has_value()});
    }
    engine.look_back(stamp);
  }
  SampleHeader header;
  header.stamp_ns = stamp.ns;
  if (slots.uses_fan) {
    std::vector<std::uint32_t> bodies(slots.capacity);
    cast_fan(*engine.past.world, slots.fan, sensor_place(X_WR, slots.spec->X_RS), slots.spec->z_m,
             engine.past.world->body_of(robot), engine.past.scratch,
             {static_cast<float*>(records), slots.capacity}, bodies);
    header.count = slots.capacity;
    return header;
  }
  // A state of its own: a question about the past changes nothing in the run.
  std::vector<std::byte> state(slots.spec->virtual_ops->state_size);
  SampleItem item;
  item.robot = robot;
  item.device = sensor;
  item.seed = engine.spec.seed;
  item.capacity = slots.capacity;
  item.X_WR = X_WR;
  item.X_WS = compose(X_WR, slots.spec->X_RS);
  item.z_m = slots.spec->z_m;
  item.header = &header;
  item.records = records;
  item.state = state.data();
  RAVE_TRY(sample_one(*slots.spec->virtual_ops, slots.instances.at(0), *engine.past.world, item));
  return header;
}

}  // namespace rave::sim
