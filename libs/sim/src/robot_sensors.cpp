// SPDX-License-Identifier: Apache-2.0
// The sensors of a group: made, configured and opened.
#include <algorithm>
#include <utility>

#include "declared_fan.hpp"
#include "plugin_call.hpp"
#include "pose_gate.hpp"
#include "robot_group_parts.hpp"
#include "sensor_age.hpp"

namespace rave::sim {
namespace {

constexpr std::size_t kQueueDepth = 256;

void allocate(SensorSlots& slots, std::size_t count) {
  slots.stride = slots.capacity * record_size(slots.spec->kind);
  // Whole words, so that records of every member are aligned.
  slots.stride = (slots.stride + 7U) / 8U * 8U;
  slots.headers.resize(count);
  slots.records.resize(slots.stride * count);
  if (slots.uses_fan) {
    slots.bodies.resize(std::size_t{slots.capacity} * count);
    slots.near.resize((count + kMemberBlock - 1) / kMemberBlock);
  }
  slots.sequence.resize(count);
  slots.failed.resize(count);
  slots.flip.resize(count);
  if (slots.is_virtual()) slots.driver_state.resize(slots.spec->virtual_ops->state_size * count);
  if (!slots.is_virtual()) {
    slots.scratch.resize(slots.stride);
    slots.heard_ns.resize(count);
    slots.before.resize(count);
    slots.refused_step.resize(count);
  }
  if (slots.queued()) {
    slots.raw_headers.resize(count);
    slots.raw_records.resize(slots.stride * count);
    slots.processing_state.resize(slots.processing->state_size() * count);
  }
}

void clear_samples(SensorSlots& slots) {
  std::fill(slots.headers.begin(), slots.headers.end(), SampleHeader{});
  std::fill(slots.raw_headers.begin(), slots.raw_headers.end(), SampleHeader{});
  std::fill(slots.records.begin(), slots.records.end(), std::byte{});
  std::fill(slots.raw_records.begin(), slots.raw_records.end(), std::byte{});
  std::fill(slots.bodies.begin(), slots.bodies.end(), BodyId::kNone);
  std::fill(slots.driver_state.begin(), slots.driver_state.end(), std::byte{});
  std::fill(slots.sequence.begin(), slots.sequence.end(), 0U);
  std::fill(slots.failed.begin(), slots.failed.end(), std::uint8_t{0});
  std::fill(slots.heard_ns.begin(), slots.heard_ns.end(), kNeverHeard_ns);
  std::fill(slots.before.begin(), slots.before.end(), SampleQueue::Before{});
  std::fill(slots.refused_step.begin(), slots.refused_step.end(), kNeverRefused);
  std::fill(slots.flip.begin(), slots.flip.end(), std::uint8_t{0});
  if (slots.fusion) slots.fusion->clear();
  if (!slots.queued()) return;
  for (std::size_t m = 0; m < slots.headers.size(); ++m) {
    slots.processing->reset(slots.processing_state_of(m));
  }
}

void describe(SensorSlots& slots, double step_s) {
  SensorInfo& info = slots.info;
  info.name = slots.spec->name.c_str();
  info.kind = slots.spec->kind;
  info.capacity = slots.capacity;
  info.X_RS = slots.spec->X_RS;
  info.z_m = slots.spec->z_m;
  info.period_s = slots.spec->period_steps * step_s;
  info.max_age_s = told_max_age_s(slots);
}

Status configure_virtual(const GroupContext& context, RobotGroup& group, SensorSlots& slots) {
  const SensorSpec& spec = *slots.spec;
  // One instance for all robots of the group. What a driver remembers of each lies in driver_state,
  // so the engine can sample robots in any order and on any thread.
  RAVE_TRY(slots.instances.make(spec.virtual_ops->instance, 1));
  auto setup = setup_with<VirtualSensorSetup>(
      spec.params, services_of(context.logs[group.members.front().value()]));
  setup.layers = spec.layers;
  setup.period_s = spec.period_steps * context.spec.step.seconds();
  setup.z_m = spec.z_m;
  RAVE_TRY_ASSIGN(
      const VirtualDeclaration declaration,
      declaration_of(*spec.virtual_ops, slots.instances.at(0), setup, spec.kind, slots.info));
  slots.capacity = slots.info.capacity;
  slots.uses_fan = declaration.uses_fan != 0;
  if (slots.uses_fan) slots.fan = FanTable::make(declaration.fan, spec.layers);
  return {};
}

/// How old the poses of the robot may be, if this is the sensor that gives them.
std::optional<Duration> staleness_of(const RobotGroup& group, const SensorSlots& slots) {
  return group.is_pose_source(slots) ? std::optional(group.type->staleness) : std::nullopt;
}

Status configure_hardware(const GroupContext& context, RobotGroup& group, SensorSlots& slots) {
  const SensorSpec& spec = *slots.spec;
  RAVE_TRY(slots.instances.make(spec.hardware_ops->instance, group.members.size()));
  for (std::size_t m = 0; m < group.members.size(); ++m) {
    auto setup = setup_of<HardwareSetup>(context, group.members[m], spec.params);
    setup.folder = group.type->folder.c_str();
    setup.device = device_of(group, spec.device, m);
    HardwareDeclaration declaration;
    const CrashNote whose =
        crash_note_of(context, group.members[m], "sensor", spec.hardware_driver());
    const CrashScope scope(whose);
    RAVE_TRY(called([&](ErrorText* error) {
      return spec.hardware_ops->configure(slots.instances.at(m), &setup, &declaration, error);
    }));
    if (declaration.capacity == 0) return fail(ErrorCode::kPlugin, "declared room for 0 records");
    // Devices of one type may differ; the columns have room for the largest.
    slots.capacity = std::max(slots.capacity, declaration.capacity);
    slots.collect = declaration.collect != 0;
    slots.live = declaration.clock == DriverClock::kLive;
    RAVE_TRY_ASSIGN(slots.max_age_s, max_age_s(spec, declaration, staleness_of(group, slots)));
    slots.info.range_min_m = declaration.range_min_m;
    slots.info.range_max_m = declaration.range_max_m;
    slots.info.bearings_rad = declaration.bearings_rad;
    slots.info.cone_rad = declaration.cone_rad;
  }
  // Such a driver delivers by its own clock, so a stepped run could not be repeated.
  if (slots.live && context.spec.live_clock == nullptr) {
    return fail(ErrorCode::kState, "follows the wall clock, but the run is stepped");
  }
  for (std::size_t m = 0; m < group.members.size(); ++m) {
    std::unique_ptr<SampleGate> gate;
    if (group.is_pose_source(slots)) {
      gate = std::make_unique<PoseGate>(spec.kind, reach_of(*group.type));
    }
    slots.queues.push_back(std::make_unique<SampleQueue>(
        spec.kind, slots.capacity, kQueueDepth, slots.live ? context.spec.live_clock : nullptr,
        std::move(gate)));
  }
  return {};
}

}  // namespace

Status make_sensor(const GroupContext& context, RobotGroup& group, SensorSlots& slots) {
  Status configured = slots.is_virtual() ? configure_virtual(context, group, slots)
                                         : configure_hardware(context, group, slots);
  if (!configured && slots.spec->hybrid) {
    return tl::unexpected(
        std::move(configured)
            .error()
            .with_context(fmt::format("real half (driver `{}`)", slots.spec->hardware_driver())));
  }
  RAVE_TRY(configured);
  // The processing of the file comes last and so works on what hybrids have fused.
  const double step_s = context.spec.step.seconds();
  describe(slots, step_s);
  if (!slots.spec->processing.empty()) {
    const double period_s = slots.is_virtual() ? slots.spec->period_steps * step_s : 0;
    RAVE_TRY_ASSIGN(slots.processing,
                    Processing::make(slots.spec->processing, slots.spec->kind, slots.capacity,
                                     period_s, range_limits_of(slots.info)));
  }
  allocate(slots, group.members.size());
  if (slots.spec->hybrid) {
    const auto count = static_cast<std::uint32_t>(group.members.size());
    const HostServices host = services_of(context.logs[group.members.front().value()]);
    RAVE_TRY_ASSIGN(slots.fusion, FusionSlots::make(*slots.spec, slots.info, count, host));
  }
  clear_samples(slots);
  return {};
}

void clear_sensors(RobotGroup& group) {
  for (SensorSlots& slots : group.sensors) {
    clear_samples(slots);
    for (auto& queue : slots.queues) queue->reopen();
  }
}

Status open_sensors(GroupContext context, RobotGroup& group) {
  for (SensorSlots& slots : group.sensors) {
    const SensorSpec& spec = *slots.spec;
    const NamedPart part = {"sensor", spec.name, spec.hardware_driver(), spec.where};
    slots.open.assign(slots.queues.size(), 0);
    for (std::size_t m = 0; m < slots.queues.size(); ++m) {
      context.note(part);
      RAVE_TRY(start_part(context, group.members[m], part, [&] {
        return called([&](ErrorText* error) {
          return spec.hardware_ops->open(slots.instances.at(m), slots.queues[m].get(), error);
        });
      }));
      // After success only: a sensor that could not be opened is not closed, unlike a device.
      slots.open[m] = 1;
    }
  }
  return {};
}

}  // namespace rave::sim
