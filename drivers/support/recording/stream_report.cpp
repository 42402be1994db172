// SPDX-License-Identifier: Apache-2.0
#include "recording/stream_report.hpp"

#include <algorithm>

namespace rave::recording {

void add_repair(std::vector<Repair>& repairs, RepairKind kind, std::int64_t count, int line) {
  for (Repair& known : repairs) {
    if (known.kind != kind) continue;
    known.count += count;
    return;
  }
  repairs.push_back({kind, count, line});
}

std::int64_t StreamReport::repaired(RepairKind repair) const noexcept {
  const auto known = std::ranges::find(repairs, repair, &Repair::kind);
  return known == repairs.end() ? 0 : known->count;
}

std::int64_t StreamReport::dropped() const noexcept {
  std::int64_t count =
      duplicates_in_window + repaired(RepairKind::kRefusedRow) + repaired(RepairKind::kOtherClock);
  // Junk rows are normally extra rows beside good ones. If nothing else is left, they were the
  // stream.
  if (rows == 0) count += repaired(RepairKind::kJunkStamp);
  return count;
}

namespace {

void count_rows(StreamReport& report, std::span<const std::int64_t> inside) {
  report.rows = static_cast<std::int64_t>(inside.size());
  if (inside.empty()) return;
  report.stamps = 1;
  for (std::size_t i = 1; i < inside.size(); ++i) {
    if (inside[i] != inside[i - 1]) ++report.stamps;
  }
  report.first_ns = inside.front();
  report.last_ns = inside.back();
  if (inside.back() > inside.front()) {
    const auto span_ns = static_cast<double>(inside.back() - inside.front());
    // Intervals, not rows: n rows have n - 1 intervals between them.
    report.mean_rate_hz = static_cast<double>(report.rows - 1) / (span_ns * 1e-9);
  }
}

}  // namespace

void describe_timing(StreamReport& report, std::span<const std::int64_t> stamps_ns,
                     std::int64_t start_ns, std::int64_t end_ns) {
  const auto first = std::lower_bound(stamps_ns.begin(), stamps_ns.end(), start_ns);
  const auto last = std::upper_bound(first, stamps_ns.end(), end_ns);
  count_rows(report, std::span(first, last));
  const auto add_gap = [&report](GapKind kind, std::int64_t from, std::int64_t length) {
    if (length > report.gap_limit_ns) report.gaps.push_back({kind, from, length});
  };
  if (first == stamps_ns.begin()) {
    const std::int64_t begin = first == stamps_ns.end() ? end_ns : std::min(*first, end_ns);
    add_gap(GapKind::kLateStart, start_ns, begin - start_ns);
  }
  // Include the row before the window and the one after it, for gaps across its ends.
  auto row = first == stamps_ns.begin() ? first : first - 1;
  for (; row != stamps_ns.end() && *row < end_ns; ++row) {
    if (row + 1 == stamps_ns.end()) {
      add_gap(GapKind::kEarlyEnd, *row, end_ns - *row);
      report.largest_age_ns = std::max(report.largest_age_ns, end_ns - *row);
      return;
    }
    const std::int64_t length = row[1] - row[0];
    add_gap(GapKind::kInside, *row, length);
    report.largest_gap_ns = std::max(report.largest_gap_ns, length);
    // At most to the end of the window, because the sample is not read later.
    report.largest_age_ns = std::max(report.largest_age_ns, std::min(row[1], end_ns) - *row);
  }
}

}  // namespace rave::recording
