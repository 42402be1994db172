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
#include "line/wake.hpp"
#include "rave/robot/device.hpp"

namespace rave::oi {

/// A sensor of this plug-in that lives on the frames of a device. Called from the device's thread,
/// one call at a time, between attach() and the return of detach().
class FrameListener {
 public:
  /// `moment_s`: when the values were true, seconds of the host's clock.
  virtual void take(const OiState& state, double moment_s) = 0;
  virtual void gone(std::string_view why) = 0;
  virtual void back() = 0;

 protected:
  ~FrameListener() = default;
};

/// A robot with the Open Interface at the other end of a line. Its thread keeps the line open, the
/// stream running and the mode as wanted, hands frames to its listeners and repeats the drive
/// command. Listeners and the drive are parts of the same plug-in.
class CreateDevice final : public HardwareDevice {
 public:
  Status configure(const HardwareDeviceSetup& setup) override;
  Status open() override;
  void close() override;
  [[nodiscard]] std::string report() const override;

  [[nodiscard]] const Geometry& geometry() const noexcept { return options_.geometry; }
  /// Before open(): the stream must hold these packets, too.
  void want(std::span<const Packet> packets);
  void attach(FrameListener& listener);
  void detach(FrameListener& listener);

  /// Tells the wheels. Any thread; does not wait. Without another call within `keep_s` they stop.
  /// Error (kIo): the robot has been away for longer than `lost_after_s`.
  Status drive(WheelSpeeds speeds, double keep_s);

 private:
  /// What the wheels are to do, by whom asked and until when.
  struct Order {
    WheelSpeeds speeds;
    line::HostTime until{};
    bool given = false;  ///< Somebody drives this robot.
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
  void stop_thread();
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

  // Of the device's thread.
  OiState robot_;
  Mode last_mode_ = Mode::kOff;
  line::HostTime last_frame_{};
  line::HostTime mode_at_{};   // when it may be asked for its mode again
  line::HostTime drive_at_{};  // when the drive command is due again
  WheelSpeeds told_;           // what the wheels were told last
  bool order_kept_ = false;    // the order was in force at the last look
  StreamDecoder::Counts counted_;
  std::uint64_t missing_before_ = 0;  // in former conversations

  std::mutex listeners_mutex_;  // guards listeners_; held while they are called
  std::vector<FrameListener*> listeners_;

  std::mutex order_mutex_;  // guards order_
  Order order_;
  std::atomic<bool> ringing_{false};  // drive() shall ring
  std::atomic<bool> lost_{false};

  mutable std::mutex state_mutex_;  // guards state_
  mutable std::condition_variable state_changed_;
  DeviceState state_;
  std::jthread thread_;  // last: it ends before what it uses is gone
};

}  // namespace rave::oi
