// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

namespace rave::runtime {

/// The dead-man's handle of robots that people drive: a drive that is not renewed ends. By wall
/// time, which the caller gives, since the hand is on a stick of the real world. One thread.
class DriveWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;
  /// A drive that is not renewed for so long becomes a zero velocity.
  static constexpr std::chrono::milliseconds kSilence{250};

  /// Somebody drives, or renews that. True: it is another velocity than before, or the first.
  bool driven(const std::string& robot, const std::string& by, double v_mps, double w_radps,
              Time now);
  /// It is not driven any more, or has been made to stand.
  void ended(const std::string& robot) { drives_.erase(robot); }
  void all_ended() { drives_.clear(); }
  [[nodiscard]] bool any() const noexcept { return !drives_.empty(); }
  [[nodiscard]] bool drives(const std::string& robot) const { return drives_.contains(robot); }

  struct Silent {
    std::string robot;
    std::string by;
    friend bool operator==(const Silent&, const Silent&) = default;
  };
  /// Those whose drivers have fallen silent while they moved: each is told once, counts as standing
  /// from now on, and is renewed by the next driven().
  [[nodiscard]] std::vector<Silent> take_silent(Time now);

 private:
  struct Drive {
    std::string by;
    double v_mps = 0;
    double w_radps = 0;
    Time renewed;
  };
  std::map<std::string, Drive, std::less<>> drives_;
};

}  // namespace rave::runtime
