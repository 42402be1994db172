// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "rave/estimate/pose_filter.hpp"

namespace rave::estimate {

/// What a leader knows of where its robots are: one filter for each, moved by the commands that the
/// robot got and corrected by what robots see of landmarks and of each other. Robots have the
/// numbers in which they were added, from 0.
///
/// Stamps are seconds of one clock. For each robot they may come out of order by no more than the
/// delay of commands; what is older than its estimate counts as of now. One thread at a time. Same
/// input, same bits.
class TeamFilter {
 public:
  TeamFilter(const MotionModel& motion, const SightingModel& sighting)
      : motion_(motion), sighting_(sighting) {}

  /// Another robot, at `X_WR` at `time_s`; sigmas in metres and radians.
  void add(const Pose2& X_WR, double position_sigma_m, double heading_sigma_rad, double time_s);
  [[nodiscard]] std::size_t size() const noexcept { return robots_.size(); }

  /// A robot was commanded this speed (m/s) and turning rate (rad/s), which holds until the next
  /// command. Precondition for all below: `robot` < size().
  void command(std::size_t robot, double time_s, double v_mps, double w_radps);
  /// Moves the estimate of a robot to this time.
  void advance(std::size_t robot, double time_s);
  /// A robot saw a landmark at `p_WL`; see PoseFilter::see().
  bool see_landmark(std::size_t robot, double time_s, Vec2 p_WL, double range_m,
                    double bearing_rad);
  /// A robot saw another one: both are corrected, if the observer believes it. Precondition:
  /// `other` is not `robot`.
  bool see_robot(std::size_t robot, std::size_t other, double time_s, double range_m,
                 double bearing_rad);

  [[nodiscard]] const PoseFilter& filter(std::size_t robot) const { return robots_[robot].filter; }
  /// Seconds from the last sighting by this robot that its filter believed until its estimate;
  /// since it was added if there was none.
  [[nodiscard]] double blind_s(std::size_t robot) const {
    return robots_[robot].now_s - robots_[robot].seen_s;
  }

 private:
  struct Command {
    double from_s = 0;  ///< When it shows in the motion.
    double v_mps = 0;
    double w_radps = 0;
  };
  struct Robot {
    PoseFilter filter;
    double now_s = 0;
    double seen_s = 0;
    Command current;
    std::deque<Command> coming;  ///< Not yet in effect, in the order of their time.
  };

  MotionModel motion_;
  SightingModel sighting_;
  std::vector<Robot> robots_;
};

}  // namespace rave::estimate
