// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "live_guard.hpp"
#include "rave/base/result.hpp"
#include "rave/robot/actuator.hpp"

namespace rave::sim {

/// A hardware actuator as its guard writes to it; no `ops`: the robot has none in this place.
struct GuardedActuator {
  const HardwareActuatorOps* ops = nullptr;
  void* instance = nullptr;
  std::string driver{};  ///< Its name, for crashes.
};

/// What became of the commands for an actuator.
struct WrittenCommand {
  Command command;      ///< The last one; kNone before the first.
  bool failed = false;  ///< The driver did not take it.
  std::string text;     ///< Why not.
};

/// What a guard tells the engine. What happened several times since the last look counts once.
struct GuardNews {
  std::uint32_t begun = 0;          ///< Bit `1 << limit` of each limit that began to act.
  std::uint32_t lost_sensor = 0;    ///< The last one that was too old; as in GuardOutput.
  std::uint32_t frozen_sensor = 0;  ///< The last one that repeated itself.
  std::vector<WrittenCommand> written;
  /// The driver has not returned from a command for so long.
  Duration stuck;
};

/// The thread of the guard of one real robot in a live run, and the only one that writes to the
/// actuators of that robot. It writes each `period` of wall time, and at once when something new is
/// ordered, whatever the engine is at. It has a thread of its own so that a driver that hangs
/// affects no other robot.
///
/// All functions belong to the engine's thread, but where they say otherwise.
class GuardThread {
 public:
  struct Setup {
    GuardSpec limits;
    LivePose pose;
    std::vector<LiveSensor> sensors;
    std::vector<LiveRanges> ranges;
    std::vector<GuardedActuator> actuators;
    const RunClock* clock = nullptr;  ///< Not owned.
    Duration period;
  };
  /// `robot`: its name, for errors and crashes. Error kIo: the system has no thread to give.
  [[nodiscard]] static Result<std::unique_ptr<GuardThread>> start(Setup setup,
                                                                  std::string_view robot);
  GuardThread(const GuardThread&) = delete;
  GuardThread& operator=(const GuardThread&) = delete;
  ~GuardThread();

  /// The order that comes next; to be filled anew each time.
  [[nodiscard]] GuardOrder& next_order() noexcept { return next_; }
  /// The order counts from now on.
  void give_order();
  /// The robot stands from now on until the next order.
  void stand();
  /// The robot stands, and the thread ends; nothing is waited for. False: it was told before.
  bool retire();
  /// Waits until the thread has ended after retire(): as long as the driver hangs. Any thread.
  void join();
  /// What happened since the last look.
  void look(GuardNews& news);
  /// Whether the thread goes before all others of the machine.
  [[nodiscard]] bool has_priority() const noexcept { return has_priority_; }

 private:
  GuardThread(Setup setup, std::string_view robot);
  void run();
  void write_all(bool stands);
  void write(std::size_t actuator, const Command& command, SimTime now);

  const Setup setup_;
  const std::string robot_;
  GuardOrder next_;  ///< The engine's.

  std::mutex mutex_;  // held for a swap only; guards what follows
  std::condition_variable wake_;
  GuardOrder latest_;
  bool fresh_ = false;
  bool woken_ = false;
  bool stands_ = false;
  bool retired_ = false;
  GuardNews news_;

  std::atomic<std::int64_t> writing_since_ns_{kNotWriting};
  static constexpr std::int64_t kNotWriting = std::numeric_limits<std::int64_t>::max();

  // The thread's own.
  LiveGuard guard_;
  GuardOrder order_;
  std::vector<Command> allowed_;
  std::vector<WrittenCommand> written_;
  bool ordered_ = false;

  bool has_priority_ = false;
  std::thread thread_;
};

}  // namespace rave::sim
