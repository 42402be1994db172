// SPDX-License-Identifier: Apache-2.0
#include "ros2/ros2_device.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "rave/base/thread.hpp"
#include "rave/ros2/names.hpp"

namespace rave::ros2_driver {

Status Ros2Device::configure(const HardwareDeviceSetup& setup) {
  RAVE_TRY_ASSIGN(options_, read_options(setup.parameters(), setup.robot.name));
  host_ = setup.host;
  // Created here instead of in open(), so that sensors can query the robot when they are
  // configured.
  RAVE_TRY_ASSIGN(participant_, ros2::Participant::open(options_.network));
  RAVE_TRY_ASSIGN(ros2::Waiter waiter, ros2::Waiter::create(*participant_));
  waiter_.emplace(std::move(waiter));
  return {};
}

Status Ros2Device::open() {
  if (!participant_) return fail(ErrorCode::kState, "opened before it was configured");
  if (thread_.joinable()) return fail(ErrorCode::kState, "opened twice; close it first");
  silent_ = 0;
  listening_ = 0;
  return start_thread(thread_, "the robot", [this](const std::stop_token& stop) { run(stop); });
}

void Ros2Device::close() {
  if (!thread_.joinable()) return;
  thread_.request_stop();
  // The thread sleeps in its waiter; the bell ends the wait.
  ring();
  thread_.join();
}

Result<std::string> Ros2Device::topic(std::string_view name) const {
  return ros2::whole_name(options_.name_space, name);
}

void Ros2Device::attach(TopicUser& user) {
  const std::lock_guard lock(users_mutex_);
  users_.push_back(&user);
}

void Ros2Device::detach(TopicUser& user) {
  const std::lock_guard lock(users_mutex_);
  std::erase(users_, &user);
}

std::size_t Ros2Device::rank(const ros2::RemoteId::Guid& participant) const {
  const std::lock_guard lock(processes_mutex_);
  return static_cast<std::size_t>(std::ranges::find(processes_, participant) - processes_.begin());
}

void Ros2Device::add_process(const ros2::RemoteId::Guid& participant) {
  const std::lock_guard lock(processes_mutex_);
  // Bounds the memory where processes come and go.
  constexpr std::size_t kMost = 1000;
  if (processes_.size() == kMost) return;
  if (std::ranges::find(processes_, participant) == processes_.end()) {
    processes_.push_back(participant);
  }
}

void Ros2Device::log(LogLevel level, std::string_view text) const { host_.write(level, text); }

Status Ros2Device::no_message(std::string_view topic, std::string_view why,
                              std::string_view refused) const {
  if (!refused.empty()) {
    return fail(ErrorCode::kTimeout, "no usable message on `{}` within {} s: {}", topic,
                options_.timing.start_timeout_s, refused);
  }
  return fail(ErrorCode::kTimeout, "no message came on `{}` within {} s: {}", topic,
              options_.timing.start_timeout_s, why);
}

void Ros2Device::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    const line::HostTime now = line::host_now();
    line::HostTime due = now + kLook;
    {
      const std::lock_guard lock(users_mutex_);
      // Each user says when it wants to be called next, such as for repeating a command. Messages
      // end the wait earlier.
      for (TopicUser* const user : users_) due = std::min(due, user->attend(now));
    }
    // The node information is written again when ends have been added since.
    participant_->announce();
    waiter_->wait(Duration{line::until(due).count() * 1'000'000});
  }
}

std::string Ros2Device::report() const {
  if (!participant_) return "{}";
  nlohmann::ordered_json json;
  json["domain"] = options_.network.domain;
  json["interface"] = options_.network.interface;
  json["namespace"] = options_.name_space;
  json["others"] = participant_->others_here();
  json["away"] = away();
  return json.dump();
}

}  // namespace rave::ros2_driver
