// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bus_options.hpp"
#include "rave/base/result.hpp"

namespace rave::cli {

/// `rave drive`, `rave goal`, `rave say` and `rave place`: what people ask of a robot.
struct OrderCommand {
  enum class What : std::uint8_t { kDrive, kGoal, kSay, kPlace };
  What what = What::kDrive;
  std::string robot;
  std::string run;              ///< Empty: the only one.
  std::vector<double> numbers;  ///< V W; X Y [X Y ...]; X Y [YAW in degrees].
  double speed_mps = 0;         ///< kGoal: largest speed; 0: chosen by the program.
  bool cancel = false;          ///< kGoal: cancels the earlier order.
  std::string text;             ///< kSay.
  double for_s = 1;             ///< kDrive: duration.
  bool force = false;           ///< Takes the robot from the person who drives it.
  BusOptions bus;
};

/// Prints what was done. Returns 0; 1 if the run refuses; 2 if there is no such run, it does not
/// answer, or the numbers are invalid.
[[nodiscard]] Result<int> give_order(const OrderCommand& options);

}  // namespace rave::cli
