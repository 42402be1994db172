// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace rave::manager {

/// How many steps a host gets through in a second, by what it says of its robots. Moments are
/// nanoseconds of one monotonic clock.
class StepRate {
 public:
  void note(std::uint64_t step, std::int64_t now_ns) noexcept;
  /// Less and less of one who falls silent; nothing in its first second.
  [[nodiscard]] std::optional<double> at(std::int64_t now_ns) const noexcept;

 private:
  static constexpr std::int64_t kWindow_ns = 1'000'000'000;
  std::optional<std::uint64_t> step_;  ///< At the beginning of the window.
  std::int64_t since_ns_ = 0;
  std::int64_t lasted_ns_ = 0;  ///< The window before.
  std::optional<double> rate_;  ///< In it.
};

}  // namespace rave::manager
