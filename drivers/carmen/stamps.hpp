// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "carmen/log_text.hpp"
#include "rave/base/result.hpp"

namespace rave::carmen {

/// What the stamps of a log are.
enum class StampedBy : std::uint8_t { kMessage, kLogger, kRate };

struct StampOptions {
  /// Scans per second of a log without usable stamps; 0: the stamps of the log.
  double rate_hz = 0;
  /// Only the order of the rows counts: where stamps would lose scans, one scan a second is
  /// assumed.
  bool order_suffices = false;
  /// The log must be stamped by its messages, because its origin was.
  bool by_message = false;
};

/// Sets `stamp_ns` of all rows by one clock, and drops the rows that do not have a time of it.
///
/// That clock is the `ipc_timestamp` of the messages. If it would lose more than 5 % of the scans
/// and the `logger_timestamp` would not, it is the latter. A scan is lost if it repeats the stamp
/// of another one, or is of another clock: with the scans in file order, the longest sequence
/// that does not step back is the clock; others belong to it if they are within 10 s of their
/// neighbours in it (`step_back`, sorted later). Rows at the start and the end that are more than
/// 1000 s away from the rest are of another clock if they are at most 5 %, and if they are more
/// than a day away however many they are. Odometry must be within 1000 s of the scans. Dropped rows
/// are reported as `other_clock`, those without a readable stamp as `junk_stamp`.
///
/// With `rate_hz` the scans have equal distances in the order of the file, and odometry is spread
/// between them. Error kInvalidArgument, with the name of that parameter: all scans have one stamp.
[[nodiscard]] Result<StampedBy> set_stamps(ParsedLog& log, const std::string& file,
                                           const StampOptions& options);

}  // namespace rave::carmen
