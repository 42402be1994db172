// SPDX-License-Identifier: Apache-2.0
// The sense phase, by blocks of robots on all threads. It reads the snapshot of the step, which
// no thread changes meanwhile, and writes the samples of its own robots only.
#include <algorithm>
#include <optional>

#include "engine_impl.hpp"
#include "listed_fan.hpp"
#include "plugin_call.hpp"
#include "rave/math/transform.hpp"
#include "rave/sim/random_devices.hpp"

namespace rave::sim {

void Engine::Impl::sense() {
  // Once per step and for all sensors: each call measures the motion since the call before.
  moves_m = motion_watch.look(truth.snapshot);
  pool.for_each_block(roster.blocks.size(), sense_effort, [this](std::size_t b, unsigned w) {
    sense_block(roster.blocks[b], workers[w]);
  });
}

void Engine::Impl::sense_block(const Block& block, Worker& worker) {
  RobotGroup& group = roster.groups[block.group];
  // Sensor by sensor, not robot by robot: the fan table and the code of a driver stay in the cache
  // for the whole block.
  for (std::uint32_t device = 0; device < group.sensors.size(); ++device) {
    SensorSlots& slots = group.sensors[device];
    if (!slots.is_virtual()) continue;
    if (due(slots.spec->period_steps, slots.spec->phase_steps)) {
      sample_members(group, slots, device, block, worker);
    }
    // With latency, a sample of an earlier step may come due in a step without sampling.
    if (!slots.queued()) continue;
    for (std::uint32_t m = block.begin; m < block.end; ++m) {
      deliver(group, slots, device, m, worker);
    }
  }
}

/// Finds where the sensors of a block stand, and the lists of what is near them; null if lists do
/// not pay.
const NearLists* Engine::Impl::find_places(const RobotGroup& group, SensorSlots& slots,
                                           const Block& block, const SinCos& mounting,
                                           Worker& worker) const {
  const SensorSpec& sensor = *slots.spec;
  const std::span<const RobotId> members =
      std::span(group.members).subspan(block.begin, block.end - block.begin);
  for (std::size_t i = 0; i < members.size(); ++i) {
    worker.places[i] =
        sensor_place(truth.movers[members[i].value()].X_WR.position(),
                     truth.snapshot.turn_WR(members[i]), sensor.X_RS.position(), mounting);
    worker.places_W[i] = worker.places[i].p_WS;
  }
  // Single long rays are followed through the grid; a list of all that is within their range would
  // be longer than what they pass.
  if (walk_pays(truth.snapshot, slots.fan)) return nullptr;
  // A sensor that samples every n steps sees n steps of motion between two uses of its lists.
  const double margin_m = NearLists::margin_for(moves_m * sensor.period_steps,
                                                0.25 * static_cast<double>(slots.fan.range_max_m));
  if (margin_m == 0) return nullptr;
  NearLists& lists = slots.near[block.begin / kMemberBlock];
  const std::span places_W(worker.places_W.data(), members.size());
  if (!lists.hold(truth.snapshot, places_W)) {
    list_near(truth.snapshot, slots.fan, sensor.z_m, members, places_W, margin_m, worker.fan,
              lists);
  }
  return &lists;
}

/// The sample of a sensor that casts no fan, by its driver.
void Engine::Impl::sample_device(RobotGroup& group, SensorSlots& slots, std::uint32_t device,
                                 std::uint32_t member, SampleHeader& header, std::byte* records,
                                 Worker& worker) {
  const SensorSpec& sensor = *slots.spec;
  const RobotId robot = group.members[member];
  SampleItem item;
  item.robot = robot;
  item.device = device;
  item.seed = spec.seed;
  item.sequence = header.sequence - 1;
  item.capacity = slots.capacity;
  item.X_WR = truth.movers[robot.value()].X_WR;
  item.X_WS = compose(item.X_WR, sensor.X_RS);
  item.z_m = sensor.z_m;
  item.elapsed_s = item.sequence == 0 ? 0 : sensor.period_steps * spec.step.seconds();
  item.header = &header;
  item.records = records;
  item.state = slots.driver_state.data() + sensor.virtual_ops->state_size * member;
  const Status sampled =
      sample_one(*sensor.virtual_ops, slots.instances.at(0), truth.snapshot, item);
  if (sampled) return;
  slots.failed[member] = 1;
  header.count = 0;
  worker.events.push_back({step, robot, EventKind::kDriverFailed, BodyId(),
                           fmt::format("sensor `{}` (driver `{}`): {}", sensor.name, sensor.driver,
                                       sampled.error().message)});
}

void Engine::Impl::sample_members(RobotGroup& group, SensorSlots& slots, std::uint32_t device,
                                  const Block& block, Worker& worker) {
  const SensorSpec& sensor = *slots.spec;
  const SinCos mounting = sincos(sensor.X_RS.yaw);
  worker.noise.clear();
  worker.noisy_members.clear();
  const NearLists* const lists =
      slots.uses_fan ? find_places(group, slots, block, mounting, worker) : nullptr;
  std::optional<ListedFans> listed;
  if (lists != nullptr) {
    listed.emplace(truth.snapshot, slots.fan, *lists,
                   std::span(worker.places).first(block.end - block.begin), worker.fan,
                   worker.fans);
  }
  const CrashNote whose = crash_note(block, "sensor", sensor.driver);
  const CrashScope scope(whose);
  for (std::uint32_t m = block.begin; m < block.end; ++m) {
    const RobotId robot = group.members[m];
    // A real robot without a pose is not in the world; its sensors cannot be placed.
    if (slots.failed[m] != 0 || !truth.movers[robot.value()].present) continue;
    const bool direct = !slots.queued();
    SampleHeader& header = direct ? slots.headers[m] : slots.raw_headers[m];
    std::byte* records = direct ? slots.records_of(m) : slots.raw_records_of(m);
    // Programs see sequence numbers from 1, since 0 means that there was no sample yet. Random
    // numbers count from 0.
    const std::uint32_t sequence = slots.sequence[m]++;
    header = {now.ns, sequence + 1, 0, 1, 0};
    if (slots.uses_fan) {
      const std::size_t first = std::size_t{slots.capacity} * m;
      const SensorPlace& place = worker.places[m - block.begin];
      const std::span ranges(reinterpret_cast<float*>(records), slots.capacity);
      const std::span bodies(slots.bodies.data() + first, slots.capacity);
      if (listed) {
        listed->read(m - block.begin, ranges, bodies);
      } else {
        cast_fan(truth.snapshot, slots.fan, place, sensor.z_m, truth.snapshot.body_of(robot),
                 worker.fan, ranges, bodies);
      }
      header.count = slots.capacity;
    } else {
      sample_device(group, slots, device, m, header, records, worker);
    }
    if (!slots.processing) {
      hash_delivery(group, slots, device, m, worker.hash);
      note_reported_pose(group, slots, m, header, records);
    } else {
      // Noise waits for the whole block, because random numbers are drawn with vector instructions
      // for many samples at once. Each sample has its own stream, so this changes no number.
      worker.noise.push_back(
          {&header, records,
           RandomStream(spec.seed, robot.value(), device | kProcessingDevice, sequence)});
      worker.noisy_members.push_back(m);
    }
  }
  if (slots.processing) process_members(group, slots, device, worker);
}

/// The noise of all samples in `worker.noise` at once; then each goes into its chain, or where
/// noise is the whole chain, it is delivered.
void Engine::Impl::process_members(RobotGroup& group, SensorSlots& slots, std::uint32_t device,
                                   Worker& worker) {
  slots.processing->apply_noise(worker.noise);
  for (std::size_t i = 0; i < worker.noise.size(); ++i) {
    const NoiseItem& item = worker.noise[i];
    const std::uint32_t m = worker.noisy_members[i];
    if (slots.queued()) {
      slots.processing->push_noisy(*item.header, item.records, slots.processing_state_of(m));
    } else {
      hash_delivery(group, slots, device, m, worker.hash);
      note_reported_pose(group, slots, m, *item.header, slots.records_of(m));
    }
  }
}

void Engine::Impl::deliver(RobotGroup& group, SensorSlots& slots, std::uint32_t device,
                           std::size_t member, Worker& worker) {
  SampleHeader header = slots.headers[member];
  if (!slots.processing->deliver(now, slots.processing_state_of(member), &header,
                                 slots.records_of(member))) {
    return;
  }
  header.fresh = 1;
  slots.headers[member] = header;
  hash_delivery(group, slots, device, member, worker.hash);
  note_reported_pose(group, slots, member, header, slots.records_of(member));
}

void Engine::Impl::hash_delivery(const RobotGroup& group, SensorSlots& slots, std::uint32_t device,
                                 std::size_t member, RunHash& sum) {
  const SampleHeader& header = slots.headers[member];
  const std::size_t bytes = std::size_t{header.count} * record_size(slots.spec->kind);
  std::byte* records = slots.records_of(member);
  // For the test that one changed bit of one percept changes the hash: flip_percept_bit().
  if (slots.flip[member] != 0 && bytes > 0) {
    records[0] ^= std::byte{1};
    slots.flip[member] = 0;
  }
  ItemHash item(step, group.members[member].value(), HashChannel::kPercept, device);
  item.add(static_cast<std::uint64_t>(header.stamp_ns));
  item.add_bytes({records, bytes});
  sum.add(item);
}

}  // namespace rave::sim
