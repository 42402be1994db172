// SPDX-License-Identifier: Apache-2.0
#include "rave/onlook/listener.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "rave/bus/sequence.hpp"
#include "rave/maps/map_messages.hpp"
#include "rave/protocol/obstacle_messages.hpp"

namespace rave::onlook {
namespace {

/// A request is repeated several times within its lifetime, since a message may be lost.
constexpr std::chrono::milliseconds kSayAgain{500};
/// Hosts in real time receive a change of the world at different times; events within this time
/// count as the same.
constexpr double kSameEvent_s = 2;
/// Limits the memory that a sender of invented messages can use.
constexpr std::size_t kMostTold = 4096;
constexpr std::size_t kMostEvents = 100'000;
constexpr std::size_t kMostTiles = 16'384;
constexpr std::size_t kMostReadings = 3 * rave_wire_kMaxLookedAt;

/// Lost messages are not requested again; room for messages of several hosts between two reads.
constexpr bus::QosProfile kHeard{.reliable = false, .depth = 4};

}  // namespace

Result<Listener> Listener::create(bus::Bus& bus) {
  Listener made;
  RAVE_TRY(bus::open_all(bus, made.looks_, made.events_in_, made.obstacles_in_, made.tiles_in_));
  RAVE_TRY(made.readings_in_.open(bus, kHeard));
  return made;
}

void Listener::look(const Asked& asked) {
  const auto now = Clock::now();
  const bool changed = asked != asked_;
  if (!changed && now < next_look_) return;
  if (changed || number_ == 0) {
    asked_ = asked;
    ++number_;
    std::erase_if(readings_, [&](const auto& entry) {
      const ReadingAt& reading = entry.second;
      return !is_asked({reading.slot, reading.sensor}) || (reading.part != 0 && !asked_.parts);
    });
    sensors_.clear();
    const std::size_t most = std::min<std::size_t>(asked_.sensors.size(), rave_wire_kMaxLookedAt);
    for (std::size_t i = 0; i < most; ++i) {
      sensors_.push_back({asked_.sensors[i].slot, asked_.sensors[i].sensor});
    }
  }
  next_look_ = now + kSayAgain;
  // A monitor that requests nothing says so once and is then forgotten.
  const bool nothing = !asked_.robots && sensors_.empty() && asked_.maps.empty();
  if (!changed && nothing && asked_.probes.empty()) return;
  bus::Look message{};
  message.number = number_;
  message.robots = asked_.robots;
  message.parts = asked_.parts;
  bus::borrow(message.sensors, sensors_);
  std::vector<std::uint32_t> maps = asked_.maps;
  if (maps.size() > rave_wire_kMaxLookedAtMaps) maps.resize(rave_wire_kMaxLookedAtMaps);
  bus::borrow(message.maps, maps);
  std::vector<rave_wire_Probe> probes;
  for (const probe::Asked& probe : asked_.probes) {
    if (probes.size() == rave_wire_kMaxProbes) break;
    rave_wire_Probe& one = probes.emplace_back();
    one.robot = probe.robot;
    one.number = probe.number;
    bus::put_text(one.block, probe.block);
  }
  bus::borrow(message.probes, probes);
  static_cast<void>(looks_.write(message));
}

bool Listener::is_asked(const LookedAt& sensor) const {
  if (!probe::is_probe(sensor.sensor)) return std::ranges::binary_search(asked_.sensors, sensor);
  return std::ranges::any_of(asked_.probes, [&sensor](const probe::Asked& probe) {
    return probe.robot == sensor.slot && probe.number == sensor.sensor;
  });
}

void Listener::hear() {
  readings_in_.take([this](const bus::Readings& sample) { hear(sample); });
  events_in_.take([this](const bus::RunEvents& sample) { hear(sample); });
  obstacles_in_.take([this](const bus::LastObstacle& sample) { hear(sample); });
  tiles_in_.take([this](const bus::MapTile& sample) {
    if (tiles_.size() < kMostTiles) tiles_.push_back(maps::tile_of(sample));
  });
}

void Listener::hear(const bus::Readings& sample) {
  const float* values = sample.values._buffer;
  for (const rave_wire_Reading& reading : bus::elements(sample.entries)) {
    const float* const first = values;
    const std::size_t count = std::size_t{reading.rows} * reading.fields;
    values += count;
    if (!is_asked({reading.robot, reading.sensor})) continue;
    if (readings_.size() >= kMostReadings) continue;
    ReadingAt& heard = readings_[{reading.robot, reading.sensor, reading.part}];
    heard.slot = reading.robot;
    heard.sensor = reading.sensor;
    heard.part = reading.part;
    heard.stamp_s = SimTime{reading.stamp_ns}.seconds();
    heard.rows = reading.rows;
    heard.fields = reading.fields;
    heard.values.assign(first, first + count);
  }
}

/// Events of the world are reported by each host.
bool Listener::is_told(const rave_wire_RunEvent& event, double t_s, std::uint64_t writer) {
  const std::string said = event.detail != 0
                               ? fmt::format("{} {} #{}", event.kind, event.other, event.detail)
                               : fmt::format("{} {} {}", event.kind, event.other, event.text);
  if (told_.size() >= kMostTold) told_.clear();
  const auto [told, fresh] = told_.try_emplace(said, Told{t_s, writer});
  if (fresh) return false;
  const bool same =
      told->second.writer != writer && std::abs(t_s - told->second.t_s) < kSameEvent_s;
  if (!same) told->second = {t_s, writer};
  return same;
}

void Listener::hear(const bus::RunEvents& sample) {
  double t_s = 0;
  for (const rave_wire_RunEvent& event : bus::elements(sample.events)) {
    t_s = SimTime{event.time_ns}.seconds();
    const bool of_world = event.robot == rave_wire_kNone;
    if (of_world && is_told(event, t_s, sample.writer)) continue;
    if (events_.size() >= kMostEvents) continue;
    events_.push_back({t_s, of_world ? RobotId() : RobotId(event.robot),
                       static_cast<sim::EventKind>(event.kind), event.text});
  }
  if (sample.left_out == 0 || events_.size() >= kMostEvents) return;
  events_.push_back({t_s, RobotId(), sim::EventKind::kContact,
                     fmt::format("{} more in this step", sample.left_out)});
}

void Listener::hear(const bus::LastObstacle& sample) {
  if (revisions_.size() >= sim::ObstacleChange::kMostAdded && !revisions_.contains(sample.id))
    return;
  std::uint64_t& known = revisions_[sample.id];
  if (known >= sample.revision) return;
  auto stands = lock_step::read_obstacle(sample.stands);
  if (!stands) {
    obstacles_in_.refuse(sample, stands.error().message);
    return;
  }
  known = sample.revision;
  obstacles_.push_back({sample.id,
                        sample.removed || stands->kind == sim::ObstacleChange::Kind::kRemove,
                        *std::move(stands)});
}

std::vector<HeardEvent> Listener::take_events() {
  std::vector<HeardEvent> events = std::exchange(events_, {});
  std::ranges::stable_sort(events, {}, &HeardEvent::t_s);
  return events;
}

std::vector<HeardObstacle> Listener::take_obstacles() { return std::exchange(obstacles_, {}); }

}  // namespace rave::onlook
