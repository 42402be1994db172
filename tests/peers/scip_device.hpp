// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "own_clock.hpp"

namespace peer {

/// The inside of a laser like the URG-04LX, without its optics: what it answers to commands.
/// Source: Hokuyo, "Communication Protocol Specification For SCIP2.0 Standard", C-42-03320B.
class ScipDevice {
 public:
  static constexpr int kFirstStep = 44;
  static constexpr int kLastStep = 725;
  static constexpr int kFrontStep = 384;
  static constexpr int kStepsPerTurn = 1024;
  static constexpr int kLeast_mm = 20;
  static constexpr int kMost_mm = 5600;
  static constexpr int kNothingInReach = 1;  // as a UTM-30LX says it

  ScipDevice(std::string model, int rpm, OwnClock clock)
      : model_(std::move(model)), rpm_(rpm), clock_(clock) {}

  /// As after power-on: laser off, and still speaking SCIP 1.1.
  void power_on();
  /// The answer to one command without its line end.
  [[nodiscard]] std::string answer(const std::string& command);
  /// The optics have a new scan: one number in millimetres for each step from the first to the
  /// last. Returns what is to be sent because of it; empty if nobody asked.
  [[nodiscard]] std::string scanned(const std::vector<int>& ranges_mm, std::int64_t t_ns);
  [[nodiscard]] std::uint32_t timer_ms() const { return timer_ms_; }

 private:
  [[nodiscard]] std::string measure(const std::string& command);
  [[nodiscard]] std::string data(const std::string& command) const;
  [[nodiscard]] std::string parameters() const;

  std::string model_;
  int rpm_;
  OwnClock clock_;
  bool scip2_ = false;
  bool laser_on_ = false;
  std::string streaming_;  // the command of a continuous measurement; empty: none
  int left_ = 0;           // scans to send; 0 with a command that asks for endless ones
  int skipped_ = 0;
  std::vector<int> ranges_mm_;
  std::uint32_t timer_ms_ = 0;
};

}  // namespace peer
