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

/// How the readings of one sensor of robot and shadow differ, since the shadow was put down.
struct ShadowReading {
  std::string sensor;
  /// `m`: mean absolute difference of the ranges of one scan that both have; of odometry, how far
  /// the ways differ. `share`: of the readings of contact that differ. Empty: not compared.
  std::string_view unit;
  double last = 0;
  double most = 0;
  std::uint64_t compared = 0;
};

/// How far a robot and its shadow are from each other.
struct ShadowDifference {
  bool running = false;  ///< The robot is real now, and known to be somewhere.
  SimTime since;         ///< When the shadow was put where the robot was.
  double m = 0;
  double rad = 0;              ///< 0 to pi.
  std::uint64_t compared = 0;  ///< Poses; with 0 nothing is known of the distances.
  double most_m = 0;
  double most_rad = 0;
  std::vector<ShadowReading> readings;  ///< By sensor.
};

/// Runs the shadows of a run beside it and measures how far they are from their robots. No part of
/// the run: nothing in it depends on them.
class Shadows final : public RunObserver {
 public:
  struct Moment {
    double time_s = 0;   ///< Of the run.
    double after_s = 0;  ///< Since the shadow was put down.
    double m = 0;
    double rad = 0;
  };

  /// Null if no robot that runs here has a shadow. `engine`: before its first step. Errors: those
  /// of ShadowWorld.
  [[nodiscard]] static Result<std::unique_ptr<Shadows>> create(
      const config::ExpandedScenario& scenario, plugin::Catalogue& catalogue,
      const sim::Engine& engine, LogSink* log);

  void after_step(const StepView& step) override;
  void record(record::RunRecorder& recorder) const override;
  [[nodiscard]] std::span<const sim::Event> events() const noexcept override { return events_; }

  /// Puts the shadow of a robot, or of all with an empty name, where the robot is, with the next
  /// step. Errors: kNotFound.
  Result<std::string> reset(std::string_view robot);
  void refresh(RunStatus& status) const;
  /// Of each robot that has a shadow here, by robot.
  [[nodiscard]] std::vector<ShadowFacts> facts() const;

 private:
  struct Shadow {
    RobotId robot;
    std::string name;
    std::unique_ptr<ShadowWorld> world;  ///< Null since it failed.
    ShadowDifference now;
    double ever_m = 0;  ///< Largest of all times that it was put down.
    double ever_rad = 0;
    std::uint64_t ever_compared = 0;
    std::uint32_t starts = 0;
    bool reset_asked = false;
    bool fresh = false;  ///< The last step compared something.
    SimTime compared_at;
    Pose2 X_WR;  ///< As compared last.
    Pose2 X_WS;
    std::vector<std::uint32_t> seen;  ///< By sensor: sequence of the last reading.
    std::vector<Pose2> odometry_R;    ///< By sensor: where the robot's began ...
    std::vector<Pose2> odometry_S;    ///< ... and the shadow's.
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
