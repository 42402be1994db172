// SPDX-License-Identifier: Apache-2.0
#include "rave/onlook/teller.hpp"

#include <algorithm>

#include "rave/base/control_characters.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/maps/map_messages.hpp"

namespace rave::onlook {
namespace {

constexpr std::chrono::milliseconds kHearing{50};
/// More than real use needs; limits the memory that a sender with invented names can use.
constexpr std::size_t kMostLooking = 64;
/// While steps are late, messages are this many times rarer: monitors get fewer updates before
/// anything else is slowed.
constexpr int kLateFactor = 10;

/// Too frequent to be kept for monitors that connect later.
bool is_frequent(sim::EventKind kind) noexcept {
  return kind == sim::EventKind::kContact || kind == sim::EventKind::kGuardSlowed ||
         kind == sim::EventKind::kGuardStopped;
}

}  // namespace

Result<Teller> Teller::create(bus::Bus& bus, Options options) {
  RAVE_TRY_ASSIGN(auto readings, bus::Writer<bus::Readings>::create(bus));
  std::optional<ObstacleTeller> obstacles;
  if (options.obstacles) {
    RAVE_TRY_ASSIGN(auto writer, bus::Writer<bus::LastObstacle>::create(bus));
    obstacles.emplace(std::move(writer));
  }
  ReadingTeller teller(std::move(readings), options.host);
  Teller made(std::move(options), std::move(teller), std::move(obstacles));
  RAVE_TRY(bus::open_all(bus, made.looks_, made.events_, made.tiles_));
  return made;
}

void Teller::hear(Clock::time_point now) {
  if (now < next_hearing_) return;
  next_hearing_ = now + kHearing;
  bool changed = false;
  looks_.take([&](const bus::Look& look) {
    const auto known = heard_.find(look.writer);
    if (known == heard_.end() && heard_.size() >= kMostLooking) return;
    Look& heard = heard_[look.writer];
    heard.heard = now;
    if (heard.number == look.number) return;
    heard.number = look.number;
    heard.asked = {look.robots, look.parts, {}, {}, {}};
    for (const rave_wire_Probe& probe : bus::elements(look.probes)) {
      heard.asked.probes.push_back({probe.robot, probe.number, probe.block});
    }
    const auto maps = bus::elements(look.maps);
    heard.asked.maps.assign(maps.begin(), maps.end());
    for (const rave_wire_LookedAt& sensor : bus::elements(look.sensors)) {
      heard.asked.sensors.push_back({sensor.robot, sensor.sensor});
    }
    changed = true;
  });
  changed |= std::erase_if(heard_, [now](const auto& entry) {
               return now - entry.second.heard > kLookHolds;
             }) > 0;
  if (!changed) return;
  asked_ = {};
  for (const auto& [writer, look] : heard_) {
    asked_.robots |= look.asked.robots;
    asked_.parts |= look.asked.parts;
    asked_.sensors.insert(asked_.sensors.end(), look.asked.sensors.begin(),
                          look.asked.sensors.end());
    asked_.maps.insert(asked_.maps.end(), look.asked.maps.begin(), look.asked.maps.end());
    asked_.probes.insert(asked_.probes.end(), look.asked.probes.begin(), look.asked.probes.end());
  }
  std::ranges::sort(asked_.sensors);
  const auto twice = std::ranges::unique(asked_.sensors);
  asked_.sensors.erase(twice.begin(), twice.end());
  readings_.begin_again();
}

void Teller::put(const sim::Event& event, SimTime time) {
  if (is_frequent(event.kind) && !asked_.robots) return;
  const bool full = told_.size() >= kMostContacts && event.kind == sim::EventKind::kContact;
  if (full || told_.size() >= rave_wire_kMaxRunEvents) {
    ++left_out_;
    return;
  }
  rave_wire_RunEvent& told = told_.emplace_back();
  told.time_ns = time.ns;
  told.robot = event.robot.valid() ? event.robot.value() : rave_wire_kNone;
  told.other = event.other.valid() ? event.other.value() : rave_wire_kNone;
  told.kind = static_cast<std::uint32_t>(event.kind);
  told.detail = is_of_obstacle(event.kind) ? event.detail : 0;
  const std::string words = options_.words ? options_.words(event) : event.text;
  bus::put_text(told.text, without_control_characters(words, " "));
}

void Teller::tell_events(const sim::Engine& engine, std::span<const sim::Event> beside) {
  if (engine.events().empty() && beside.empty()) return;
  told_.clear();
  left_out_ = 0;
  for (const sim::Event& event : engine.events()) put(event, engine.time());
  for (const sim::Event& event : beside) put(event, engine.time());
  if (told_.empty()) return;
  bus::RunEvents message{};
  message.host = options_.host;
  message.left_out = left_out_;
  bus::borrow(message.events, told_);
  static_cast<void>(events_.write(message));
}

/// Also runs after the last monitor has left: a later one finds the map complete.
void Teller::tell_maps(const sim::Engine& engine, Clock::time_point now, int slower) {
  if (!asked_.maps.empty()) maps_.ask(engine, asked_.maps);
  for (maps::MapTile& tile : maps_.changed(engine, now, slower)) {
    bus::MapTile message = maps::message_of(tile);
    // A monitor that is too slow gets the next tile of this place.
    static_cast<void>(tiles_.write(message));
  }
}

void Teller::tell_readings(const sim::Engine& engine, Clock::time_point now, int slower) {
  if (options_.catalogue != nullptr) probes_.ask(engine, *options_.catalogue, asked_.probes);
  if (asked_.sensors.empty() && probes_.empty()) return;
  readings_.tell(engine, asked_, probes_, now, slower);
}

void Teller::after_step(const sim::Engine& engine, std::span<const sim::Event> beside, bool late) {
  const auto now = Clock::now();
  hear(now);
  if (obstacles_) obstacles_->after_step(engine, beside);
  tell_events(engine, beside);
  tell_readings(engine, now, late ? kLateFactor : 1);
  if (!maps_.empty()) maps_.after_step(engine);
  tell_maps(engine, now, late ? kLateFactor : 1);
}

void Teller::held(const sim::Engine& engine) {
  const auto now = Clock::now();
  hear(now);
  tell_readings(engine, now, 1);
  tell_maps(engine, now, 1);
}

}  // namespace rave::onlook
