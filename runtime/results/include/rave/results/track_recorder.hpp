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

/// Keeps where each robot was, thinned to what a picture can show, with the gaps of its pose source
/// and, for real robots, the track that their commanded velocity alone would give.
class TrackRecorder final : public RunObserver {
 public:
  struct Wish {
    double duration_s = 0;        ///< Of the run.
    std::string odometry_sensor;  ///< Whose velocity is integrated; empty for none.
    bool tracks = true;           ///< False: only the length of each way is wanted.
  };
  /// `spec.local` says which robots run here.
  TrackRecorder(const BodyKinds& kinds, const sim::EngineSpec& spec, const Wish& wish);

  /// Of a step that comes late only one point in ten is kept: a picture can do with less.
  void after_step(const StepView& step) override;
  /// Of robots that run here: one track each, then the odometry-only ones; none if none are wanted.
  [[nodiscard]] std::vector<TrackFacts> facts() const;

  /// Where a robot that something tells its pose was said to be in the last step; null: it is told
  /// the truth.
  [[nodiscard]] const sim::ReportedPose* reported(RobotId robot) const noexcept {
    return told_[robot.value()] != 0 ? &reported_[robot.value()] : nullptr;
  }

  /// Length of the way of each robot, metres, by RobotId.
  [[nodiscard]] const std::vector<double>& way_m() const noexcept { return way_m_; }

 private:
  struct Odometry {
    std::uint32_t sensor = 0;
    std::optional<Pose2> X_WR;  ///< None until the robot has a pose.
  };
  void follow_pose(const sim::Engine& engine, std::uint32_t robot, bool keep);
  void follow_odometry(const sim::Engine& engine, std::uint32_t robot, bool keep);

  bool wanted_ = true;
  std::uint64_t every_ = 1;
  std::vector<report::PictureTrack> poses_;
  std::vector<report::PictureTrack> odometry_tracks_;
  std::vector<std::optional<Odometry>> odometry_;
  std::vector<std::uint8_t> here_;  ///< By robot: it runs here.
  std::vector<std::uint8_t> told_;  ///< ... and something tells it where it is.
  std::vector<sim::ReportedPose> reported_;
  std::vector<std::optional<Pose2>> last_;
  std::vector<double> way_m_;
  std::vector<std::int64_t> last_stamp_ns_;
};

}  // namespace rave::runtime
