// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rave/observe/kinds.hpp"
#include "rave/observe/run_observer.hpp"
#include "rave/report/picture.hpp"
#include "rave/results/facts.hpp"

namespace rave::runtime {

/// Records the track of each robot, thinned to the resolution of a picture, with the gaps of its
/// pose source and, for real robots, the track integrated from their commanded velocity.
class TrackRecorder final : public RunObserver {
 public:
  struct Options {
    double duration_s = 0;        ///< Duration of the run.
    std::string odometry_sensor;  ///< Sensor whose velocity is integrated; empty for none.
    bool tracks = true;           ///< False: record only the travelled distance.
  };
  /// `spec.local` lists the robots that run here.
  TrackRecorder(const BodyKinds& kinds, const sim::EngineSpec& spec, const Options& options);

  /// If steps are late, only one point in ten is kept.
  void after_step(const StepView& step) override;
  /// Of the robots that run here: one track each, then those from odometry; none if not requested.
  [[nodiscard]] std::vector<TrackFacts> facts() const;

  /// Reported pose of a robot with a pose source in the last step; null if it uses the true pose.
  [[nodiscard]] const sim::ReportedPose* reported(RobotId robot) const noexcept {
    return told_[robot.value()] != 0 ? &reported_[robot.value()] : nullptr;
  }

  /// Travelled distance of each robot in metres, by RobotId.
  [[nodiscard]] const std::vector<double>& way_m() const noexcept { return way_m_; }

 private:
  struct Odometry {
    std::uint32_t sensor = 0;
    std::optional<Pose2> X_WR;  ///< Empty until the robot has a pose.
  };
  void follow_pose(const sim::Engine& engine, std::uint32_t robot, bool keep);
  void follow_odometry(const sim::Engine& engine, std::uint32_t robot, bool keep);

  bool wanted_ = true;
  std::uint64_t every_ = 1;
  std::vector<report::PictureTrack> poses_;
  std::vector<report::PictureTrack> odometry_tracks_;
  std::vector<std::optional<Odometry>> odometry_;
  std::vector<std::uint8_t> here_;  ///< By robot: whether it runs here.
  std::vector<std::uint8_t> told_;  ///< By robot: whether it runs here and has a pose source.
  std::vector<sim::ReportedPose> reported_;
  std::vector<std::optional<Pose2>> last_;
  std::vector<double> way_m_;
  std::vector<std::int64_t> last_stamp_ns_;
};

}  // namespace rave::runtime
