// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rave::recording {

/// What the reader mended, so that nobody takes mended data for whole data.
enum class RepairKind : std::uint8_t {
  kDuplicateStamp,    ///< Rows dropped because a later row has the same stamp (not of sightings).
  kStepBack,          ///< Rows stamped before their predecessor; the stream was sorted, stably.
  kSkippedRow,        ///< Rows with wrong columns, left out because the caller asked for it.
  kSkippedNonFinite,  ///< Rows with NaN or infinity, left out because the caller asked for it.
  kHeadingWrapped,    ///< Headings outside (-pi, pi], brought into it.
  kCutLine,           ///< The log ended in the middle; the broken last line was left out.
  kJunkStamp,         ///< Rows dropped because their stamp means nothing.
};

/// Which part of the window a gap lies in.
enum class GapKind : std::uint8_t {
  kInside,     ///< Between two rows.
  kLateStart,  ///< From the start of the window to the first row: there is no value to hold.
  kEarlyEnd,   ///< From the last row to the end of the window: the last value is held.
};

[[nodiscard]] std::string_view to_string(RepairKind kind) noexcept;
[[nodiscard]] std::string_view to_string(GapKind kind) noexcept;

struct Repair {
  RepairKind kind = RepairKind::kDuplicateStamp;
  std::int64_t count = 0;
  /// Line of the first case in the unpacked text, from 1.
  int first_line = 0;
};

/// A stretch without rows that is longer than the stream's limit. Nanoseconds from the origin.
struct Gap {
  GapKind kind = GapKind::kInside;
  std::int64_t start_ns = 0;
  std::int64_t length_ns = 0;
};

/// What one stream of a recording holds within the window that was asked for. Times count from the
/// origin of the recording. Repairs are counted over the whole file, all else over the window.
struct StreamReport {
  /// File name without folder, and the SHA-256 (hexadecimal) of its bytes as they lie on disk.
  std::string file;
  std::string sha256;
  /// Whether the digest equals the one in `stretch.txt`; none if that lists no such file.
  std::optional<bool> unchanged;

  std::int64_t rows = 0;
  /// Different stamps among the rows (sightings share them).
  std::int64_t stamps = 0;
  std::optional<std::int64_t> first_ns;
  std::optional<std::int64_t> last_ns;
  /// Rows per second between the first and the last row; 0 with fewer than two stamps.
  double mean_rate_hz = 0;

  std::int64_t gap_limit_ns = 0;
  /// Longer than the limit, in order of time; length as recorded even where the window cuts it.
  std::vector<Gap> gaps;
  /// The largest gap between two rows, whatever the limit, and where it starts.
  std::int64_t largest_gap_ns = 0;
  std::int64_t largest_gap_start_ns = 0;
  /// The oldest that the latest row gets at any moment of the window, its end included.
  std::int64_t largest_age_ns = 0;

  std::vector<Repair> repairs;
  /// Rows of the window that are not played because a later row has the same stamp.
  std::int64_t duplicates_in_window = 0;

  /// Adds to the count of a kind of repair; the line of the first call is kept.
  void add_repair(RepairKind repair, std::int64_t count, int line);
  /// How often a kind of repair was made.
  [[nodiscard]] std::int64_t repaired(RepairKind repair) const noexcept;
  /// Rows of the window that are not played. Of rows without a usable stamp nobody knows whether
  /// they belong to the window, so all of them count; those that a mapping program put into a log
  /// (`junk_stamp`) only if there is nothing else.
  [[nodiscard]] std::int64_t dropped() const noexcept;
};

/// Fills everything between `rows` and `largest_age_ns` from the stamps of a stream: all stamps
/// known, ascending, also those outside of [start_ns, end_ns].
void describe_timing(StreamReport& report, std::span<const std::int64_t> stamps_ns,
                     std::int64_t start_ns, std::int64_t end_ns);

}  // namespace rave::recording
