// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "rave/math/pose.hpp"
#include "recording/stream_report.hpp"
#include "recording/window.hpp"

// Converts the rows of a log to the samples of a window. Rows have an absolute `stamp_ns` and a
// `line`, samples a `t_ns` from the origin.
namespace rave::recording {

/// Sorts rows by stamp, stably, and reports each step back.
template <class Row>
void sort_rows(std::vector<Row>& rows, StreamReport& report) {
  bool sorted = true;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i].stamp_ns >= rows[i - 1].stamp_ns) continue;
    add_repair(report.repairs, RepairKind::kStepBack, 1, rows[i].line);
    sorted = false;
  }
  if (sorted) return;
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row& a, const Row& b) { return a.stamp_ns < b.stamp_ns; });
}

/// Keeps the last row of each stamp, whose value holds from then on. `rows`: sorted.
template <class Row>
void drop_duplicates(std::vector<Row>& rows, const StreamWindow& window, StreamReport& report) {
  std::vector<Row> kept;
  kept.reserve(rows.size());
  for (const Row& row : rows) {
    if (!kept.empty() && kept.back().stamp_ns == row.stamp_ns) {
      add_repair(report.repairs, RepairKind::kDuplicateStamp, 1, row.line);
      const std::int64_t t_ns = row.stamp_ns - window.origin_ns;
      const bool inside = t_ns >= window.start_ns && t_ns <= window.end_ns;
      report.duplicates_in_window += inside ? 1 : 0;
      kept.back() = row;
    } else {
      kept.push_back(row);
    }
  }
  rows = std::move(kept);
}

/// Wraps the heading into (-pi, pi] and reports a change.
void wrap_heading(Pose2& pose, int line, StreamReport& report);

/// Sets the timing of the report from all samples, including those outside of the window.
template <class Sample>
void describe(StreamReport& report, const std::vector<Sample>& samples,
              const StreamWindow& window) {
  std::vector<std::int64_t> stamps;
  stamps.reserve(samples.size());
  for (const Sample& sample : samples) stamps.push_back(sample.t_ns);
  describe_timing(report, stamps, window.start_ns, window.end_ns);
}

/// Cuts the samples to the window and its margin, and keeps one sample before it.
template <class Sample>
void trim(std::vector<Sample>& samples, const StreamWindow& window) {
  const std::int64_t first_ns = window.start_ns - window.margin_ns;
  const std::int64_t last_ns = window.end_ns + window.margin_ns;
  const auto later = [](std::int64_t t, const Sample& sample) { return t < sample.t_ns; };
  samples.erase(std::upper_bound(samples.begin(), samples.end(), last_ns, later), samples.end());
  const auto first = std::upper_bound(samples.begin(), samples.end(), first_ns, later);
  if (first != samples.begin()) samples.erase(samples.begin(), first - 1);
}

}  // namespace rave::recording
