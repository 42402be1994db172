// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"

namespace rave::udp_pose {

/// The content of a datagram. All numbers are finite.
struct PoseDatagram {
  std::string body;
  double t_s = 0;  ///< Sender's clock.
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;  ///< In (-pi, pi].
  struct Variance {
    double x_m2 = 0;
    double y_m2 = 0;
    double yaw_rad2 = 0;
  };
  std::optional<Variance> variance;
  std::optional<std::int64_t> seq;
};

/// Longer datagrams are refused.
inline constexpr std::size_t kMaxDatagram = 2048;

/// Parses one JSON object: `body` (text, 1 to 64 bytes), `t`, `x`, `y`, `yaw` (numbers), `cov`
/// (optional: three non-negative numbers), `seq` (optional: a non-negative integer). Strict:
/// unknown, missing or duplicate keys, NaN, infinities, implausible numbers and data after the
/// object are errors (kParse).
[[nodiscard]] Result<PoseDatagram> parse_datagram(std::string_view bytes);

}  // namespace rave::udp_pose
