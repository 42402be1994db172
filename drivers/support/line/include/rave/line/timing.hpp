// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/plugin/params.hpp"

namespace rave::line {

/// Timeouts of a driver for a real device, and the delay of its data.
struct Timing {
  double latency_s = 0;
  double start_timeout_s = 0;
  double lost_after_s = 0;
};

/// The parameter `latency_s`: the least delay until data arrives.
constexpr ParamSpec latency_param(const char* doc, double max_s = 1) noexcept {
  return number_param("latency_s", "s", 0, 0, max_s, doc);
}

/// The parameter `start_timeout_s`: the timeout at the start of a run.
constexpr ParamSpec start_timeout_param(const char* doc) noexcept {
  return number_param("start_timeout_s", "s", 5, 0.1, 600, doc);
}

/// The parameter `lost_after_s`: the silence after which a loss is reported.
constexpr ParamSpec lost_after_param(double value_s, const char* doc) noexcept {
  return number_param("lost_after_s", "s", value_s, 0.1, 600, doc);
}

/// Reads the three parameters, all of which the driver must have.
[[nodiscard]] constexpr Timing read_timing(const Params& params) noexcept {
  return {params.number("latency_s"), params.number("start_timeout_s"),
          params.number("lost_after_s")};
}

}  // namespace rave::line
