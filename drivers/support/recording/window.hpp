// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"
#include "recording/stretch.hpp"

namespace rave::recording {

/// The parameters for converting rows of a log to samples. Nanoseconds; the window is relative to
/// the origin.
struct StreamWindow {
  std::int64_t origin_ns = 0;  ///< Absolute.
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
  std::int64_t margin_ns = 0;
};

/// The requested part of a recording, seconds from its origin, both ends included. Unset: all.
struct WindowOptions {
  std::optional<double> start_s;
  std::optional<double> end_s;
  /// Margin that is also kept at both ends, seconds in [0, 1000].
  double margin_s = 1.0;
};

/// Error kInvalidArgument, with the name, unless least <= value <= most.
[[nodiscard]] Status check_seconds(std::string_view name, double value, double least, double most);

/// The window within the stretch. Without a stretch it is within the first and last absolute stamp,
/// and the first is the origin. `path` is used in messages. Errors: kInvalidArgument (values out of
/// range; a window that is empty or exceeds the data), kParse (neither stretch nor rows: first_ns >
/// last_ns).
[[nodiscard]] Result<StreamWindow> choose_window(const std::optional<Stretch>& stretch,
                                                 std::int64_t first_ns, std::int64_t last_ns,
                                                 const WindowOptions& options,
                                                 const std::string& path);

}  // namespace rave::recording
