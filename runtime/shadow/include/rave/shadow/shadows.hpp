// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"
#include "rave/observe/run_observer.hpp"
#include "rave/plugin/catalogue.hpp"
#include "rave/record/run_record.hpp"
#include "rave/results/facts.hpp"
#include "rave/shadow/shadow_world.hpp"

namespace rave::runtime {

/// The difference between the readings of one sensor of robot and shadow, since the last reset of
/// the shadow.
struct ShadowReading {
  std::string sensor;
  /// `m`: mean absolute difference of the ranges that both scans have; for odometry, the difference
  /// of the travelled paths. `share`: fraction of the contact readings that differ. Empty: not
  /// compared.
  std::string_view unit;
  double last = 0;
  double most = 0;
  std::uint64_t compared = 0;
};

/// The difference between a robot and its shadow.
struct ShadowDifference {
  bool running = false;  ///< The robot is real now and its pose is known.
  SimTime since;         ///< Time of the last reset of the shadow to the robot's pose.
  double m = 0;
  double rad = 0;              ///< 0 to pi.
  std::uint64_t compared = 0;  ///< Number of compared poses; with 0 the distances are unknown.
  double most_m = 0;
  double most_rad = 0;
  std::vector<ShadowReading> readings;  ///< By sensor.
};

/// Runs the shadows of a run and measures their difference from the robots. The run does not depend
/// on them.
class Shadows final : public RunObserver {
 public:
  struct Moment {
    double time_s = 0;   ///< Time of the run.
    double after_s = 0;  ///< Time since the last reset of the shadow.
    double m = 0;
    double rad = 0;
  };

  /// Returns null if no robot that runs here has a shadow. `engine`: before its first step. Errors:
  /// those of ShadowWorld.
  [[nodiscard]] static Result<std::unique_ptr<Shadows>> create(
      const config::ExpandedScenario& scenario, plugin::Catalogue& catalogue,
      const sim::Engine& engine, LogSink* log);

  void after_step(const StepView& step) override;
  void record(record::RunRecorder& recorder) const override;
  [[nodiscard]] std::span<const sim::Event> events() const noexcept override { return events_; }

  /// Places the shadow of a robot (of all robots if the name is empty) at the robot's pose in the
  /// next step. Errors: kNotFound.
  Result<std::string> reset(std::string_view robot);
  void refresh(RunStatus& status) const;
  /// Of each robot that has a shadow here, by robot.
  [[nodiscard]] std::vector<ShadowFacts> facts() const;

 private:
  struct Shadow {
    RobotId robot;
    std::string name;
    std::unique_ptr<ShadowWorld> world;  ///< Null after a failure.
    ShadowDifference now;
    double ever_m = 0;  ///< Largest value over all resets.
    double ever_rad = 0;
    std::uint64_t ever_compared = 0;
    std::uint32_t starts = 0;
    bool reset_asked = false;
    bool fresh = false;  ///< Robot and twin were compared in the last step.
    SimTime compared_at;
    Pose2 X_WR;  ///< Poses of the last comparison.
    Pose2 X_WS;
    std::vector<std::uint32_t> seen;  ///< By sensor: sequence of the last reading.
    std::vector<Pose2> odometry_R;    ///< By sensor: first odometry pose of the robot ...
    std::vector<Pose2> odometry_S;    ///< ... and of the shadow.
    std::vector<Moment> moments;
    double moment_every_s = 1;
    double next_moment_s = 0;
  };

  explicit Shadows(LogSink* log) : log_(log) {}
  void follow(const StepView& step, Shadow& shadow);
  void begin(const sim::Engine& engine, Shadow& shadow);
  void compare(const sim::Engine& engine, Shadow& shadow);
  void compare_readings(const sim::Engine& engine, Shadow& shadow);
  void compare_ranges(const sim::SensorSample& real, std::uint32_t sensor, Shadow& shadow);
  void keep_moment(double time_s, Shadow& shadow) const;

  LogSink* log_;
  std::vector<Shadow> shadows_;
  std::vector<sim::Event> events_;
  std::vector<float> ranges_;
};

}  // namespace rave::runtime
