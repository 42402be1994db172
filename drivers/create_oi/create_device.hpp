// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "create_oi/create_options.hpp"
#include "create_oi/create_report.hpp"
#include "create_oi/oi_session.hpp"
#include "create_oi/wheel_speeds.hpp"
#include "rave/line/wake.hpp"
#include "rave/robot/device.hpp"

namespace rave::oi {

/// A sensor of this plug-in that uses the frames of a device. Called from the device's thread, one
/// call at a time, between attach() and the return of detach().
class FrameListener {
 public:
  /// `moment_s`: time at which the values were true, in seconds of the host's clock.
  virtual void take(const OiState& state, double moment_s) = 0;
  virtual void gone(std::string_view why) = 0;
  virtual void back() = 0;

 protected:
  ~FrameListener() = default;
};

/// A robot with the Open Interface on a line. Its thread keeps the line open, the stream running
/// and the mode set, passes frames to its listeners and repeats the drive command. Listeners and
/// the drive belong to the same plug-in.
class CreateDevice final : public HardwareDevice {
 public:
  Status configure(const HardwareDeviceSetup& setup) override;
  Status open() override;
  void close() override;
  [[nodiscard]] std::string report() const override;

  [[nodiscard]] const Geometry& geometry() const noexcept { return options_.geometry; }
  /// Adds packets to the stream. Call it before open().
  void want(std::span<const Packet> packets);
  void attach(FrameListener& listener);
  void detach(FrameListener& listener);

  /// Sets the wheel speeds. Any thread; does not block. They stop after `keep_s` without another
  /// call. Error (kIo): the robot has been disconnected for longer than `lost_after_s`.
  Status drive(WheelSpeeds speeds, double keep_s);

 private:
  /// The speeds of the wheels and their expiry.
  struct Order {
    WheelSpeeds speeds;
    line::HostTime until{};
    bool given = false;  ///< An actuator drives this robot.
  };

  void run(const std::stop_token& stop);
  [[nodiscard]] Status talk_until_lost(const std::stop_token& stop);
  [[nodiscard]] Status converse(OiSession& session, const std::stop_token& stop);
  [[nodiscard]] Status keep_driving(OiSession& session);
  [[nodiscard]] Status keep_mode(OiSession& session);
  void take(const Frame& frame, OiSession& session);
  void note_counts(const OiSession& session);
  [[nodiscard]] bool pause(line::Wait wait, const std::stop_token& stop);
  void lost(const Error& why);
  void found();
  void forget_order();
  void log(LogLevel level, const std::string& text) const;
  [[nodiscard]] std::string name() const {
    return "the robot at `" + options_.address.text() + "`";
  }

  template <class Change>
  void note(Change change) {
    const std::lock_guard lock(state_mutex_);
    change(state_);
  }

  DeviceOptions options_;
  HostServices host_;
  std::vector<std::uint8_t> packets_;
  bool configured_ = false;
  line::Wake wake_;  // rung by close(), and by drive() while the stream runs

  // Used by the device's thread only.
  OiState robot_;
  Mode last_mode_ = Mode::kOff;
  line::HostTime last_frame_{};
  line::HostTime mode_at_{};   // time of the next request for the mode
  line::HostTime drive_at_{};  // when the drive command is due again
  WheelSpeeds told_;           // the last speeds sent
  bool order_kept_ = false;    // the order was in force when last checked
  StreamDecoder::Counts counted_;
  std::uint64_t missing_before_ = 0;  // in earlier sessions

  std::mutex listeners_mutex_;  // guards listeners_; held while they are called
  std::vector<FrameListener*> listeners_;

  std::mutex order_mutex_;  // guards order_
  Order order_;
  std::atomic<bool> ringing_{false};  // drive() must ring the bell
  std::atomic<bool> lost_{false};

  mutable std::mutex state_mutex_;  // guards state_
  mutable std::condition_variable state_changed_;
  DeviceState state_;
  std::jthread thread_;  // last member: it ends before the members it uses are destroyed
};

}  // namespace rave::oi
