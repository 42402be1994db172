// SPDX-License-Identifier: Apache-2.0
#include "recording/window.hpp"

#include "rave/base/time.hpp"

namespace rave::recording {

Status check_seconds(std::string_view name, double value, double least, double most) {
  if (value >= least && value <= most) return {};
  return fail(ErrorCode::kInvalidArgument, "{} is {}: expected seconds from {} to {}", name, value,
              least, most);
}

Result<StreamWindow> choose_window(const std::optional<Stretch>& stretch, std::int64_t first_ns,
                                   std::int64_t last_ns, const WindowOptions& options,
                                   const std::string& path) {
  constexpr double kLongest_s = 1e9;
  RAVE_TRY(check_seconds("start_s", options.start_s.value_or(0), 0, kLongest_s));
  RAVE_TRY(check_seconds("end_s", options.end_s.value_or(0), 0, kLongest_s));
  RAVE_TRY(check_seconds("margin_s", options.margin_s, 0, 1000));
  StreamWindow window;
  if (stretch) {
    // A shipped stretch states its own origin, so all robots of a data set have one time, whichever
    // of their logs are read.
    window = {stretch->origin_ns, stretch->start_ns, stretch->end_ns, 0};
  } else if (first_ns > last_ns) {
    return fail(ErrorCode::kParse, "no log in `{}` has a row", path);
  } else {
    window = {first_ns, 0, last_ns - first_ns, 0};
  }
  const StreamWindow held = window;
  if (options.start_s) window.start_ns = from_seconds(*options.start_s).ns;
  if (options.end_s) window.end_ns = from_seconds(*options.end_s).ns;
  window.margin_ns = from_seconds(options.margin_s).ns;
  if (window.start_ns >= held.start_ns && window.end_ns <= held.end_ns &&
      window.start_ns < window.end_ns) {
    return window;
  }
  return fail(ErrorCode::kInvalidArgument,
              "the window from {} to {} s is empty or not within the {} to {} s that `{}` holds",
              Duration{window.start_ns}.seconds(), Duration{window.end_ns}.seconds(),
              Duration{held.start_ns}.seconds(), Duration{held.end_ns}.seconds(), path);
}

}  // namespace rave::recording
