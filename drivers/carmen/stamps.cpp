// SPDX-License-Identifier: Apache-2.0
#include "carmen/stamps.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rave::carmen {
namespace {

using recording::add_repair;
using recording::RepairKind;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kDisorder_ns = 10 * kSecond_ns;
constexpr std::int64_t kPause_ns = 1000 * kSecond_ns;
constexpr std::int64_t kDay_ns = 86'400 * kSecond_ns;
/// A good log loses few scans, one with a stuck clock nearly all. Few are one in twenty.
constexpr std::size_t kFew = 20;

using Clock = std::optional<std::int64_t> RowStamps::*;
using Indices = std::vector<std::size_t>;

/// The indices of the longest subsequence that does not decrease.
Indices longest_ascent(std::span<const std::int64_t> stamps) {
  Indices ends;  // of the best sequence of each length
  std::vector<std::size_t> before(stamps.size());
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const auto place = std::upper_bound(
        ends.begin(), ends.end(), stamps[i],
        [&](std::int64_t stamp_ns, std::size_t end) { return stamp_ns < stamps[end]; });
    before[i] = place == ends.begin() ? i : *(place - 1);
    if (place == ends.end()) {
      ends.push_back(i);
    } else {
      *place = i;
    }
  }
  Indices ascent(ends.size());
  std::size_t i = ends.empty() ? 0 : ends.back();
  for (std::size_t k = ascent.size(); k-- > 0; i = before[i]) ascent[k] = i;
  return ascent;
}

/// Cuts off what stands apart at both ends of an ascending sequence.
Indices largest_block(std::span<const std::int64_t> stamps, const Indices& ascent) {
  struct Block {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  std::vector<Block> blocks{{0, ascent.empty() ? 0U : 1U}};
  for (std::size_t k = 1; k < ascent.size(); ++k) {
    const bool apart = stamps[ascent[k]] - stamps[ascent[k - 1]] > kPause_ns;
    if (apart) blocks.push_back({k, k});
    blocks.back().end = k + 1;
  }
  const auto largest = std::ranges::max_element(
      blocks, {}, [](const Block& block) { return block.end - block.begin; });
  const auto foreign = [&](std::size_t from, std::size_t outside) {
    const std::int64_t gap_ns = stamps[ascent[from]] - stamps[ascent[from - 1]];
    return gap_ns > kDay_ns || outside <= ascent.size() / kFew;
  };
  auto first = largest;
  while (first != blocks.begin() && !foreign(first->begin, first->begin)) --first;
  auto last = largest;
  while (last + 1 != blocks.end() && !foreign(last->end, ascent.size() - last->end)) ++last;
  return {ascent.begin() + static_cast<std::ptrdiff_t>(first->begin),
          ascent.begin() + static_cast<std::ptrdiff_t>(last->end)};
}

/// Which of the stamps, in file order, are of the clock of the log.
std::vector<bool> of_one_clock(std::span<const std::int64_t> stamps) {
  const Indices clock = largest_block(stamps, longest_ascent(stamps));
  std::vector<bool> kept(stamps.size(), false);
  for (const std::size_t i : clock) kept[i] = true;
  std::size_t next = 0;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    if (kept[i]) {
      ++next;
      continue;
    }
    // Before the first and behind the last row of the clock the nearest one counts.
    const std::size_t left = next == 0 ? clock.front() : clock[next - 1];
    const std::size_t right = next == clock.size() ? clock.back() : clock[next];
    kept[i] = stamps[i] >= stamps[left] - kDisorder_ns && stamps[i] <= stamps[right] + kDisorder_ns;
  }
  return kept;
}

/// What a clock would make of the scans of a log.
struct Fit {
  Indices scans;  ///< Those with a time of the clock.
  std::size_t lost = 0;
  std::size_t distinct = 0;
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;
};

template <class Row>
std::pair<Indices, std::vector<std::int64_t>> stamped(const std::vector<Row>& rows, Clock clock) {
  std::pair<Indices, std::vector<std::int64_t>> all;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::optional<std::int64_t>& stamp_ns = rows[i].stamps.*clock;
    if (!stamp_ns) continue;
    all.first.push_back(i);
    all.second.push_back(*stamp_ns);
  }
  return all;
}

Fit fit(const ParsedLog& log, Clock clock) {
  Fit fit;
  const auto [indices, stamps] = stamped(log.scans, clock);
  const std::vector<bool> kept = of_one_clock(stamps);
  std::vector<std::int64_t> times;
  for (std::size_t k = 0; k < indices.size(); ++k) {
    if (!kept[k]) continue;
    fit.scans.push_back(indices[k]);
    times.push_back(stamps[k]);
  }
  std::ranges::sort(times);
  if (!times.empty()) {
    fit.first_ns = times.front();
    fit.last_ns = times.back();
  }
  times.erase(std::unique(times.begin(), times.end()), times.end());
  fit.distinct = times.size();
  fit.lost = log.scans.size() - fit.distinct;
  return fit;
}

/// Whether most of the odometry is not of the clock of the scans.
bool odometry_is_apart(const ParsedLog& log, const Fit& fit, Clock clock) {
  const auto apart = std::ranges::count_if(log.odometry, [&](const OdometryRow& row) {
    const std::optional<std::int64_t>& stamp_ns = row.stamps.*clock;
    return !stamp_ns || *stamp_ns < fit.first_ns - kPause_ns || *stamp_ns > fit.last_ns + kPause_ns;
  });
  return static_cast<std::size_t>(apart) > log.odometry.size() / kFew;
}

/// Keeps the rows of these indices, sets their stamps, and reports the others.
template <class Row>
void keep(std::vector<Row>& rows, const Indices& indices, Clock clock,
          std::vector<recording::Repair>& repairs) {
  std::vector<Row> kept;
  kept.reserve(indices.size());
  for (std::size_t i = 0, k = 0; i < rows.size(); ++i) {
    Row& row = rows[i];
    if (k < indices.size() && indices[k] == i) {
      row.stamp_ns = *(row.stamps.*clock);
      kept.push_back(row);
      ++k;
      continue;
    }
    const bool readable = (row.stamps.*clock).has_value();
    add_repair(repairs, readable ? RepairKind::kOtherClock : RepairKind::kJunkStamp, 1, row.line);
  }
  rows = std::move(kept);
}

void stamp_by(ParsedLog& log, const Fit& fit, Clock clock) {
  const auto [indices, stamps] = stamped(log.odometry, clock);
  Indices near;
  std::vector<std::int64_t> near_stamps;
  for (std::size_t k = 0; k < indices.size(); ++k) {
    if (stamps[k] < fit.first_ns - kPause_ns || stamps[k] > fit.last_ns + kPause_ns) continue;
    near.push_back(indices[k]);
    near_stamps.push_back(stamps[k]);
  }
  const std::vector<bool> kept = of_one_clock(near_stamps);
  Indices used;
  for (std::size_t k = 0; k < near.size(); ++k) {
    if (kept[k]) used.push_back(near[k]);
  }
  keep(log.scans, fit.scans, clock, log.scan_repairs);
  keep(log.odometry, used, clock, log.odometry_repairs);
}

void stamp_by_rate(ParsedLog& log, double rate_hz) {
  const auto at = [&](double scans) {
    return static_cast<std::int64_t>(scans / rate_hz * static_cast<double>(kSecond_ns));
  };
  for (std::size_t i = 0; i < log.scans.size(); ++i) {
    log.scans[i].stamp_ns = at(static_cast<double>(i + 1));
  }
  std::size_t scans = 0;
  for (auto row = log.odometry.begin(); row != log.odometry.end();) {
    while (scans < log.scans.size() && log.scans[scans].line < row->line) ++scans;
    const auto end = std::find_if(row, log.odometry.end(), [&](const OdometryRow& later) {
      return scans < log.scans.size() && later.line > log.scans[scans].line;
    });
    const auto count = static_cast<double>(end - row);
    for (double k = 1; row != end; ++row, ++k) {
      row->stamp_ns = at(static_cast<double>(scans) + k / (count + 1));
    }
  }
}

}  // namespace

Result<StampedBy> set_stamps(ParsedLog& log, const std::string& file, const StampOptions& options) {
  if (options.rate_hz > 0) {
    stamp_by_rate(log, options.rate_hz);
    return StampedBy::kRate;
  }
  const std::size_t few = log.scans.size() / kFew;
  const Fit message = fit(log, &RowStamps::message_ns);
  const Fit logger = fit(log, &RowStamps::logger_ns);
  const bool apart = odometry_is_apart(log, message, &RowStamps::message_ns);
  const bool poor = message.lost > few || apart;
  log.mixed_clocks = apart || message.scans.size() < log.scans.size();
  if (!options.by_message && poor && logger.lost <= few &&
      !odometry_is_apart(log, logger, &RowStamps::logger_ns)) {
    stamp_by(log, logger, &RowStamps::logger_ns);
    return StampedBy::kLogger;
  }
  if (options.order_suffices && message.lost > few && !options.by_message) {
    stamp_by_rate(log, 1);
    return StampedBy::kRate;
  }
  if (log.scans.size() > 1 && message.distinct <= 1 && logger.distinct <= 1) {
    return fail(ErrorCode::kInvalidArgument,
                "`{}`: all {} scans have the same stamp, so their times are not known; `rate_hz` "
                "gives the number of scans in a second",
                file, log.scans.size());
  }
  const bool by_logger = message.distinct <= 1 && logger.distinct > 1 && !options.by_message;
  const Clock clock = by_logger ? &RowStamps::logger_ns : &RowStamps::message_ns;
  stamp_by(log, by_logger ? logger : message, clock);
  return by_logger ? StampedBy::kLogger : StampedBy::kMessage;
}

}  // namespace rave::carmen
