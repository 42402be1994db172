// SPDX-License-Identifier: Apache-2.0
// What pages ask of the robots of a run, and who drives them.
#include <cmath>
#include <utility>

#include "live/live_source.hpp"

namespace rave::gui_server {
namespace {

constexpr auto kStatusInterval = std::chrono::milliseconds(200);

/// What the run is asked by a person.
request::Request request_of(request::Action action, std::string robot, const Author& author) {
  return {std::move(action), std::move(robot), author.name, author.overrides, author.page};
}

/// As it is shown, so that what stands is not told again.
double to_tenth_of_mm(double value) { return std::round(value * 1e4) / 1e4; }

runtime::RunStatus::Shadow rounded(runtime::RunStatus::Shadow shadow) {
  for (double* const value :
       {&shadow.m, &shadow.rad, &shadow.most_m, &shadow.most_rad, &shadow.since_s}) {
    *value = to_tenth_of_mm(*value);
  }
  if (auto& offset = shadow.offset_W) {
    for (double* const value : {&offset->x, &offset->y, &offset->yaw}) {
      *value = to_tenth_of_mm(*value);
    }
  }
  for (auto& reading : shadow.readings) {
    reading.last = to_tenth_of_mm(reading.last);
    reading.most = to_tenth_of_mm(reading.most);
  }
  return shadow;
}

constexpr const char* kNoRelay =
    "Orders need a direct line to the host of the robot, and there is none; with `gui: {relay: "
    "true}` in the scenario the server forwards them.";

}  // namespace

void LiveSource::halt(const HaltMessage& halt, const Author& author, Reply reply) {
  std::vector<std::string> robots;
  for (const std::uint32_t slot : halt.slots) {
    if (slot < start_.robots.size()) robots.push_back(start_.robots[slot]);
  }
  // A request without a robot means all robots; the host decides which they are at that moment.
  if (halt.slots.empty()) robots.emplace_back();
  if (robots.empty()) return reply(false, "There is no such robot.");
  for (std::string& robot : robots) {
    request::Action action = request::Stop();
    if (!halt.stop) action = request::Release();
    auto answer = port_->post(request_of(std::move(action), std::move(robot), author));
    if (!answer) return reply(false, answer.error().message);
    asked_.push_back({*std::move(answer), reply});
  }
}

void LiveSource::keep_chat(const ChatText& said) {
  // The answer does not depend on the recording; its writer reports its own errors.
  const auto to = request::addressee(said.to).value_or(request::Addressee::kAll);
  static_cast<void>(port_->post(
      {request::Chat{said.number, said.role, to, said.name, said.text}, {}, said.from}));
}

void LiveSource::command(const CommandMessage& command, const Author& author,
                         const SlotReply& reply) {
  const auto post = [&](request::Request request, std::uint32_t slot) {
    auto answer = port_->post(std::move(request));
    if (!answer) return reply(slot, false, answer.error().message);
    asked_.push_back({*std::move(answer), [reply, slot](bool good, std::string text) {
                        reply(slot, good, std::move(text));
                      }});
  };
  if (command.of_obstacle()) return post(request_of(command.action, {}, author), kNoSlot);
  // Robots that are driven by way of a server would stop with it.
  // Placing takes a lease, which a page that goes leaves by the same way.
  const auto* const gift = command.as<request::Give>();
  const bool leaves = gift != nullptr && gift->to == author.name;
  const bool passes =
      leaves || command.is<request::Set, request::Place, request::HandOver, request::ResetShadow>();
  if (!start_.about.relay && !passes) {
    for (const std::uint32_t slot : command.slots) reply(slot, false, kNoRelay);
    return;
  }
  for (std::size_t i = 0; i < command.slots.size(); ++i) {
    const std::uint32_t slot = command.slots[i];
    if (slot >= start_.robots.size()) {
      reply(slot, false, "There is no such robot.");
      continue;
    }
    post(request_of(command.action_for(i), start_.robots[slot], author), slot);
  }
}

void LiveSource::answer_asked() {
  // Who gets an answer may ask again at once, which makes the list longer meanwhile.
  std::vector<Asked> all = std::exchange(asked_, {});
  for (Asked& asked : all) {
    if (asked.answer.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
      asked_.push_back(std::move(asked));
      continue;
    }
    const auto answer = asked.answer.get();
    asked.reply(answer.has_value(), answer ? *answer : answer.error().message);
  }
}

/// Pictures do not say who drives.
void LiveSource::learn_status(Playhead::Clock::time_point now) {
  if (now - status_at_ < kStatusInterval) return;
  status_at_ = now;
  std::vector<runtime::RunStatus::Robot> robots = port_->robots();
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (i < known_robots_.size() && robots[i] == known_robots_[i]) continue;
    const auto slot = slots_.find(robots[i].name);
    if (slot != slots_.end()) learn_leases(robots[i], slot->second);
  }
  known_robots_ = std::move(robots);
}

void LiveSource::learn_leases(const runtime::RunStatus::Robot& robot, std::uint32_t slot) {
  DriveState now{slot,           robot.lease,      robot.takes,
                 robot.order,    robot.lease_page, robot.hand_over,
                 robot.simulated};
  // Where it is is in the pictures.
  if (now.hand_over) now.hand_over->x_m = now.hand_over->y_m = now.hand_over->yaw_rad = 0;
  if (robot.shadow) now.shadow = rounded(*robot.shadow);
  now.values = set_values_.of(slot, robot.changed);
  DriveState& known = leases_[slot];
  if (known == now) return;
  known = std::move(now);
  leases_changed_[slot] = ++leases_revision_;
}

std::vector<DriveState> LiveSource::leases_changed_since(std::uint64_t revision) const {
  std::vector<DriveState> changed;
  for (const DriveState& state : leases_) {
    if (leases_changed_[state.slot] > revision) changed.push_back(state);
  }
  return changed;
}

}  // namespace rave::gui_server
