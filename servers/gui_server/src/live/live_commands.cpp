// SPDX-License-Identifier: Apache-2.0
// What pages ask of the robots of a run, and who drives them.
#include <cmath>
#include <utility>

#include "live/live_source.hpp"
#include "rave/control/chat_line.hpp"

namespace rave::gui_server {
namespace {

using runtime::RunRequest;
constexpr auto kStatusInterval = std::chrono::milliseconds(200);

/// What the run is asked by a person.
RunRequest request_of(RunRequest request, const Author& author) {
  request.by = author.name;
  request.overrides = author.overrides;
  request.page = author.page;
  return request;
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
    RunRequest request;
    request.kind = halt.stop ? RunRequest::Kind::kStop : RunRequest::Kind::kRelease;
    request.robot = std::move(robot);
    auto answer = port_->post(request_of(std::move(request), author));
    if (!answer) return reply(false, answer.error().message);
    asked_.push_back({*std::move(answer), reply});
  }
}

void LiveSource::keep_chat(const ChatText& said) {
  // The answer does not depend on the recording; its writer reports its own errors.
  static_cast<void>(port_->post(
      runtime::chat_request({said.number, said.from, said.role, said.to, said.name, said.text})));
}

void LiveSource::command(const CommandMessage& command, const Author& author,
                         const SlotReply& reply) {
  const auto post = [&](RunRequest request, std::uint32_t slot) {
    auto answer = port_->post(std::move(request));
    if (!answer) return reply(slot, false, answer.error().message);
    asked_.push_back({*std::move(answer), [reply, slot](bool good, std::string text) {
                        reply(slot, good, std::move(text));
                      }});
  };
  const RunRequest& order = command;
  if (command.of_obstacle()) return post(request_of(order, author), kNoSlot);
  // Robots that are driven by way of a server would stop with it.
  using Kind = CommandMessage::Kind;
  // Placing takes a lease, which a page that goes leaves by the same way.
  const bool leaves = command.kind == Kind::kGive && command.value == author.name;
  const bool passes = command.kind == Kind::kSet || command.kind == Kind::kPlace ||
                      command.kind == Kind::kHandOver || command.kind == Kind::kResetShadow ||
                      leaves;
  if (!start_.about.relay && !passes) {
    for (const std::uint32_t slot : command.slots) reply(slot, false, kNoRelay);
    return;
  }
  RunRequest all = request_of(order, author);
  const bool shared = command.kind == Kind::kPath || command.points.size() <= 1;
  if (!shared) all.points.clear();
  for (std::size_t i = 0; i < command.slots.size(); ++i) {
    const std::uint32_t slot = command.slots[i];
    if (slot >= start_.robots.size()) {
      reply(slot, false, "There is no such robot.");
      continue;
    }
    RunRequest request = all;
    request.robot = start_.robots[slot];
    if (!shared) request.points = {command.points[i]};
    post(std::move(request), slot);
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
