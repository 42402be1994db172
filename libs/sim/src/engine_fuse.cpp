// SPDX-License-Identifier: Apache-2.0
// Hybrid sensors: the virtual half is computed for the pose and the world at the stamp of the real
// sample, which lies in the past. So they need the history of poses and obstacles.
#include <algorithm>
#include <cstring>

#include "engine_impl.hpp"
#include "plugin_call.hpp"
#include "rave/math/transform.hpp"
#include "rave/sim/random_devices.hpp"

namespace rave::sim {
namespace {

/// A body that is nearer than this touches.
constexpr double kTouch_m = 1e-3;

/// Random numbers of the noise of one half.
RandomStream half_stream(const EngineSpec& spec, RobotId robot, std::uint32_t device,
                         std::uint32_t half_bit, const SampleHeader& sample) {
  return {spec.seed, robot.value(), device | half_bit, sample.sequence};
}

}  // namespace

/// Where a robot was when its real sample was taken. Nothing if that is not known: before the first
/// pose of a real robot, so long after its newest that it may be anywhere, or before the history.
std::optional<Pose2> Engine::Impl::own_pose_at(RobotId robot, SimTime stamp,
                                               Duration staleness) const {
  if (history.empty() || stamp < history.front().time) return std::nullopt;
  const std::uint32_t r = robot.value();
  // show_past() has put it there; fuse() calls it first.
  if (truth.movers[r].simulated) return fusion_world->movers[r].X_WR;
  const auto newest = tracks[r].newest();
  if (!newest || stamp - *newest > staleness) return std::nullopt;
  return tracks[r].carried_to(stamp, staleness);
}

/// Puts all robots where they were at `stamp`: simulated ones between the frames of the history,
/// real ones on their tracks, carried on by their velocity where the track ends.
void Engine::Impl::show_past(SimTime stamp) {
  FusionWorld& past_world = *fusion_world;
  if (past_world.valid && past_world.world.time() == stamp) return;
  std::size_t i = history.size() - 1;
  while (i > 0 && history[i].time > stamp) --i;
  const HistoryFrame& a = history[i];
  const HistoryFrame& b = history[std::min(i + 1, history.size() - 1)];
  const Duration gap = b.time - a.time;
  // A stamp after the last frame has no second one: b is a, and s is 0.
  const double s = gap.ns > 0 ? static_cast<double>((stamp - a.time).ns) / double(gap.ns) : 0;
  past_world.movers.resize(truth.movers.size());
  for (std::uint32_t r = 0; r < truth.movers.size(); ++r) {
    const RobotId robot(r);
    world::RobotState state = a.robots[r];
    if (truth.movers[r].simulated) {
      if (s > 0) state.X_WR = interpolate(a.robots[r].X_WR, b.robots[r].X_WR, s);
    } else {
      const auto pose = tracks[r].carried_to(stamp, spec.types[spec.robots[r].type].staleness);
      state.present = pose.has_value();
      state.X_WR = pose.value_or(Pose2{});
    }
    past_world.movers[r] = {state.X_WR, truth.movers[r].simulated, state.present};
    past_world.world.set_robot(robot, state);
    past_world.world.set_touch(robot, a.touch[r]);
  }
  truth.journal.show(past_world.world, past_world.obstacles, truth.journal.revision_at(stamp));
  past_world.world.set_time(stamp);
  past_world.world.rebuild();
  past_world.valid = true;
}

Status Engine::Impl::sample_virtual_half(const SensorSlots& slots, RobotId robot, const Pose2& X_WR,
                                         std::size_t member) {
  FusionSlots& fusion = *slots.fusion;
  FusionWorld& past_world = *fusion_world;
  const SensorSpec& sensor = *slots.spec;
  const auto device = static_cast<std::uint32_t>(&slots - roster.group_of(robot).sensors.data());
  const SampleHeader& real = fusion.real_headers[member];
  SampleHeader& header = fusion.imagined_headers[member];
  std::byte* const records = fusion.imagined_records_of(member);
  header = {real.stamp_ns, real.sequence, 0, 1, 0};
  if (fusion.uses_fan) {
    cast_fan(
        past_world.world, fusion.fan, sensor_place(X_WR, sensor.X_RS), sensor.z_m,
        past_world.world.body_of(robot), past_world.scratch,
        {reinterpret_cast<float*>(records), fusion.capacity},
        std::span(fusion.bodies).subspan(std::size_t{fusion.capacity} * member, fusion.capacity));
    header.count = fusion.capacity;
    return {};
  }
  if (sensor.kind == ReadingKind::kContact) {
    // What was touched in the step may have been a layer that this half does not sense.
    past_world.notes.clear();
    truth.resolver.probe(robot.value(), past_world.world, 0, kTouch_m, past_world.movers,
                         past_world.notes, sensor.layers);
    const bool touching = !past_world.notes.empty();
    past_world.world.set_touch(
        robot, touching ? TouchState{true, past_world.notes.back().direction_W} : TouchState{});
  }
  SampleItem item;
  item.robot = robot;
  item.device = device;
  item.seed = spec.seed;
  // As of a virtual sensor, whose numbers of samples begin at 0.
  item.sequence = real.sequence - 1;
  item.capacity = fusion.capacity;
  item.X_WR = X_WR;
  item.X_WS = compose(X_WR, sensor.X_RS);
  item.z_m = sensor.z_m;
  const std::int64_t last_ns = fusion.last_stamp[member];
  item.elapsed_s = last_ns < 0 ? 0 : Duration{real.stamp_ns - last_ns}.seconds();
  item.header = &header;
  item.records = records;
  item.state = fusion.state.data() + sensor.hybrid->virtual_ops->state_size * member;
  const CrashNote whose = crash_note(robot, robot, "sensor", sensor.hybrid->virtual_driver);
  const CrashScope scope(whose);
  return sample_one(*sensor.hybrid->virtual_ops, fusion.imagined.at(0), past_world.world, item);
}

// The next sample that is delivered counts these as dropped.
bool Engine::Impl::withhold(FusionSlots& fusion, std::size_t member, const SampleHeader& sample) {
  fusion.withheld[member] += sample.count + sample.dropped;
  return false;
}

void Engine::Impl::fail_fusion(const SensorSlots& slots, RobotId robot, std::size_t member,
                               std::string_view driver, std::string_view why) {
  slots.fusion->failed[member] = 1;
  note({step, robot, EventKind::kDriverFailed, BodyId(),
        fmt::format("sensor `{}` (driver `{}`): {}", slots.spec->name, driver, why)});
}

/// Makes one reading of the real sample in `slots.scratch` and what the virtual half reads at its
/// stamp, in place. False: there is none, because one half is not known.
bool Engine::Impl::fuse(RobotGroup& group, SensorSlots& slots, std::size_t member,
                        SampleHeader& sample) {
  FusionSlots& fusion = *slots.fusion;
  if (fusion.failed[member] != 0) return withhold(fusion, member, sample);
  const RobotId robot = group.members[member];
  const auto device = static_cast<std::uint32_t>(&slots - group.sensors.data());
  const SimTime stamp{sample.stamp_ns};
  if (!history.empty() && stamp >= history.front().time) show_past(stamp);
  const auto X_WR = own_pose_at(robot, stamp, group.type->staleness);
  if (!X_WR) {
    // Without the virtual half a reading would say that a virtual wall is not there.
    if (truth.movers[robot.value()].present) ++fusion.too_late[member];
    return withhold(fusion, member, sample);
  }
  SampleHeader& real = fusion.real_headers[member];
  std::byte* const real_records = fusion.real_records_of(member);
  real = sample;
  real.fresh = 1;
  const std::size_t bytes = std::size_t{sample.count} * record_size(slots.spec->kind);
  if (bytes > 0) std::memcpy(real_records, slots.scratch.data(), bytes);
  // Each half gets its own noise before they are fused: afterwards nothing says which half a
  // reading is from.
  if (fusion.real_noise) {
    fusion.real_noise->apply_noise(real, real_records,
                                   half_stream(spec, robot, device, kRealHalfDevice, sample));
  }
  if (const Status seen = sample_virtual_half(slots, robot, *X_WR, member); !seen) {
    fail_fusion(slots, robot, member, slots.spec->hybrid->virtual_driver, seen.error().message);
    return withhold(fusion, member, sample);
  }
  if (fusion.imagined_noise) {
    fusion.imagined_noise->apply_noise(
        fusion.imagined_headers[member], fusion.imagined_records_of(member),
        half_stream(spec, robot, device, kVirtualHalfDevice, sample));
  }
  SampleHeader result = real;
  result.count = 0;
  const FuseItem item{&real,
                      real_records,
                      &fusion.imagined_headers[member],
                      fusion.imagined_records_of(member),
                      &result,
                      slots.scratch.data()};
  const CrashNote whose = crash_note(robot, robot, "sensor", slots.spec->driver);
  const CrashScope scope(whose);
  ErrorText error;
  if (slots.spec->hybrid->ops->fuse(fusion.driver.at(0), &item, &error) != 0) {
    fail_fusion(slots, robot, member, slots.spec->driver, error.text);
    return withhold(fusion, member, sample);
  }
  sample.count = std::min(result.count, slots.capacity);
  sample.dropped += fusion.withheld[member];
  fusion.withheld[member] = 0;
  fusion.last_stamp[member] = sample.stamp_ns;
  return true;
}

}  // namespace rave::sim
