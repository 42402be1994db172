// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "rave/line/host_clock.hpp"
#include "rave/robot/device.hpp"
#include "rave/ros2/reader.hpp"
#include "rave/ros2/waiter.hpp"
#include "ros2/ros2_options.hpp"

namespace rave::ros2_driver {

/// A part of this plug-in that uses topics of a device. Called from the device's thread, one call
/// at a time, between attach() and the return of detach(), while the device is open.
class TopicUser {
 public:
  /// Processes received messages and due tasks. Returns the latest time of the next call.
  virtual line::HostTime attend(line::HostTime now) = 0;

 protected:
  ~TopicUser() = default;
};

/// A ROS 2 robot on the network. Its thread waits for messages and calls the sensors and actuators
/// of this plug-in that use it.
class Ros2Device final : public HardwareDevice {
 public:
  Status configure(const HardwareDeviceSetup& setup) override;
  Status open() override;
  void close() override;
  [[nodiscard]] std::string report() const override;

  // For its users, after configure().
  [[nodiscard]] const ros2::Participant& participant() const noexcept { return *participant_; }
  [[nodiscard]] const DeviceOptions& options() const noexcept { return options_; }
  /// The absolute name of a topic of this robot. Errors: those of ros2::whole_name().
  [[nodiscard]] Result<std::string> topic(std::string_view name) const;
  /// Wakes the device's thread when a reader of its users receives a message.
  [[nodiscard]] const ros2::Waiter& waiter() const noexcept { return *waiter_; }
  void attach(TopicUser& user);
  void detach(TopicUser& user);
  /// Makes the device's thread call all its users now. Any thread.
  void ring() const noexcept { waiter_->ring(); }
  /// Counts the sensors that have been silent for too long. Any thread.
  void count_silent(bool more) noexcept { silent_ += more ? 1 : -1; }
  /// Counts the open sensors that may not be silent. Any thread.
  void count_listening(bool more) noexcept { listening_ += more ? 1 : -1; }
  /// Whether all sensors of the robot are silent, so that it may not receive commands either. A
  /// single silent sensor is faulty by itself; the guard handles that.
  [[nodiscard]] bool away() const noexcept { return silent_ > 0 && silent_ >= listening_; }
  /// The place of a process, by its participant, among those in which topics of the robot were
  /// found; a large number: in none. Any thread.
  [[nodiscard]] std::size_t rank(const ros2::RemoteId::Guid& participant) const;
  void add_process(const ros2::RemoteId::Guid& participant);
  void log(LogLevel level, std::string_view text) const;

  /// Waits for a message of `reader` for which `suits(const Message&, writer)` is true, at most for
  /// the start timeout. Error kTimeout gives the reason. Host's thread.
  template <class Message, class Suits>
  [[nodiscard]] Status await(ros2::Reader<Message>& reader, Suits&& suits) const {
    RAVE_TRY_ASSIGN(const ros2::Waiter waiter, ros2::Waiter::create(participant()));
    RAVE_TRY(waiter.watch(reader.handle()));
    const line::HostTime end =
        line::after_seconds(line::host_now(), options_.timing.start_timeout_s);
    std::optional<std::string> mismatch;
    while (true) {
      bool found = false;
      reader.take([&](const Message& message, dds_instance_handle_t writer) {
        found = found || suits(message, writer);
      });
      if (found) return {};
      if (auto text = reader.take_mismatch()) mismatch = std::move(text);
      const line::Wait left = line::until(end);
      if (left == line::Wait::zero()) {
        return no_message(reader.topic(), mismatch.value_or(reader.explain_silence()),
                          reader.trouble());
      }
      waiter.wait(Duration{std::min(left, kLook).count() * 1'000'000});
    }
  }

 private:
  /// Period of polling for events that wake no reader.
  static constexpr line::Wait kLook{50};

  [[nodiscard]] Status no_message(std::string_view topic, std::string_view why,
                                  std::string_view refused) const;
  void run(const std::stop_token& stop);

  DeviceOptions options_;
  HostServices host_;
  std::unique_ptr<ros2::Participant> participant_;
  std::optional<ros2::Waiter> waiter_;
  std::atomic<int> silent_{0};
  std::atomic<int> listening_{0};

  mutable std::mutex processes_mutex_;  // guards processes_
  std::vector<ros2::RemoteId::Guid> processes_;

  std::mutex users_mutex_;  // guards users_; held while they are called
  std::vector<TopicUser*> users_;
  std::jthread thread_;  // last member: it ends before the members it uses are destroyed
};

}  // namespace rave::ros2_driver
