// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace rave::manager {

/// Steps per second of a host, from the reports of its robots. Times are nanoseconds of one
/// monotonic clock.
class StepRate {
 public:
  void note(std::uint64_t step, std::int64_t now_ns) noexcept;
  /// Decreases while the host is silent; empty in its first second.
  [[nodiscard]] std::optional<double> at(std::int64_t now_ns) const noexcept;

 private:
  static constexpr std::int64_t kWindow_ns = 1'000'000'000;
  std::optional<std::uint64_t> step_;  ///< Step at the beginning of the window.
  std::int64_t since_ns_ = 0;
  std::int64_t lasted_ns_ = 0;  ///< Length of the previous window.
  std::optional<double> rate_;  ///< Rate in the previous window.
};

}  // namespace rave::manager
