// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rave::recording {

/// Repairs by the reader, reported so that repaired data are not taken for intact data.
enum class RepairKind : std::uint8_t {
  kDuplicateStamp,  ///< Rows dropped because a later row has the same stamp (not of sightings).
  kStepBack,        ///< Rows with a stamp before that of their predecessor; the stream was sorted,
                    ///< stably.
  kHeadingWrapped,  ///< Headings outside (-pi, pi], wrapped.
  kCutLine,         ///< A truncated last line, left out.
  kJunkStamp,       ///< Rows dropped because their stamp is invalid.
  kRefusedRow,      ///< Rows dropped because they cannot be read.
  kOtherClock,      ///< Rows dropped because their stamp is far from those around them.
};

/// The position of a gap in the window.
enum class GapKind : std::uint8_t {
  kInside,     ///< Between two rows.
  kLateStart,  ///< From the start of the window to the first row: no value to hold.
  kEarlyEnd,   ///< From the last row to the end of the window: the last value is held.
};

struct Repair {
  RepairKind kind = RepairKind::kDuplicateStamp;
  std::int64_t count = 0;
  /// Line of the first occurrence in the unpacked text, from 1.
  int first_line = 0;
};

/// Counts a repair under its kind; `line` is kept for the first one.
void add_repair(std::vector<Repair>& repairs, RepairKind kind, std::int64_t count, int line);

/// An interval without rows that exceeds the stream's limit. Nanoseconds from the origin.
struct Gap {
  GapKind kind = GapKind::kInside;
  std::int64_t start_ns = 0;
  std::int64_t length_ns = 0;
};

/// What identifies the file of a log.
struct LogIdentity {
  /// File name without folder, and SHA-256 of the file in hexadecimal.
  std::string file;
  std::string sha256;
  /// Whether the digest equals the one in `stretch.txt`; empty if that does not list the file.
  std::optional<bool> unchanged;
  /// Other files of its folder that decide on how it is read.
  std::vector<std::string> beside;
};

/// The content of one stream of a recording within the requested window. Times are from the origin
/// of the recording. Repairs are counted in the whole file, everything else in the window.
struct StreamReport : LogIdentity {
  std::int64_t rows = 0;
  /// Number of distinct stamps (sightings may share one).
  std::int64_t stamps = 0;
  std::optional<std::int64_t> first_ns;
  std::optional<std::int64_t> last_ns;
  /// Rows per second between the first and the last row; 0 with fewer than two stamps.
  double mean_rate_hz = 0;

  std::int64_t gap_limit_ns = 0;
  /// Gaps above the limit, in order of time, with their full lengths even if the window cuts them.
  std::vector<Gap> gaps;
  /// The largest gap between two rows, also below the limit.
  std::int64_t largest_gap_ns = 0;
  /// The largest age of the latest row within the window, its end included.
  std::int64_t largest_age_ns = 0;

  std::vector<Repair> repairs;
  /// Rows of the window that are skipped because a later row has the same stamp.
  std::int64_t duplicates_in_window = 0;

  /// The count of a kind of repair.
  [[nodiscard]] std::int64_t repaired(RepairKind repair) const noexcept;
  /// Rows of the window that are not played. Rows without a usable stamp cannot be assigned to the
  /// window, so all of them count (`refused_row`, `other_clock`); those added by a mapping program
  /// (`junk_stamp`) count only if there are no others.
  [[nodiscard]] std::int64_t dropped() const noexcept;
};

/// Sets all members from `rows` to `largest_age_ns` from the stamps of a stream: all known stamps,
/// ascending, including those outside of [start_ns, end_ns].
void describe_timing(StreamReport& report, std::span<const std::int64_t> stamps_ns,
                     std::int64_t start_ns, std::int64_t end_ns);

}  // namespace rave::recording
