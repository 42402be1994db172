// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "rave/request/order.hpp"

namespace rave::runtime {

/// The dead-man's switch for robots that users drive: a drive command that is not renewed ends. It
/// uses wall time, passed by the caller, because the user is in the real world. One thread.
class DriveWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;
  /// A drive command that was not renewed for this long becomes a zero velocity.
  static constexpr std::chrono::milliseconds kSilence{200};

  /// Records or renews a drive command. Returns true if it is new or has changed.
  bool driven(const std::string& robot, const std::string& by, const request::Drive& drive,
              Time now, std::uint64_t page = 0);
  /// The robot is no longer driven, or was stopped.
  void ended(const std::string& robot) { drives_.erase(robot); }
  void all_ended() { drives_.clear(); }
  [[nodiscard]] bool any() const noexcept { return !drives_.empty(); }
  [[nodiscard]] bool drives(const std::string& robot) const { return drives_.contains(robot); }
  /// Whether the last velocity of this page of a person lets the robot move.
  [[nodiscard]] bool moves(const std::string& robot, const std::string& by,
                           std::uint64_t page) const;

  struct Silent {
    std::string robot;
    std::string by;
    std::uint64_t page = 0;
    friend bool operator==(const Silent&, const Silent&) = default;
  };
  /// Robots whose drive commands were not renewed while they moved. Each is returned once and then
  /// counts as standing, until the next driven().
  [[nodiscard]] std::vector<Silent> take_silent(Time now);

 private:
  struct Drive {
    std::string by;
    std::uint64_t page = 0;
    request::Drive asked;
    Time renewed;
  };
  std::map<std::string, Drive, std::less<>> drives_;
};

}  // namespace rave::runtime
