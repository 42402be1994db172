// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <rave/robot/program.hpp>
#include <rave/robot/scan.hpp>

/// A program for any robot with a range sensor (laser, sonar, infra-red) and a controller that
/// takes velocities.
class @CLASS@ : public rave::DecisionProcess {
 public:
  rave::Status start(const rave::Setup& setup) override;
  void decide(const rave::Percepts& percepts, rave::Commands& commands) override;
  rave::Status parameters_changed(const rave::Params& params) override;

 private:
  rave::Scan scan_;  // All range sensors together.
  rave::ControllerHandle drive_;
  double speed_mps_ = 0;
  double stop_m_ = 0;
};
