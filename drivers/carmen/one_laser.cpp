// SPDX-License-Identifier: Apache-2.0
#include "carmen/one_laser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

namespace rave::carmen {
namespace {

/// The most frequent key; the first of several.
template <class Key>
Key most_frequent(const std::map<Key, std::size_t>& counts) {
  return std::ranges::max_element(counts, {}, [](const auto& entry) { return entry.second; })
      ->first;
}

void keep_message(ParsedLog& log) {
  std::map<const ScanMessage*, std::size_t> counts;
  const bool poses =
      std::ranges::any_of(log.scans, [](const ScanRow& row) { return row.X_WL.has_value(); });
  for (const ScanRow& row : log.scans) {
    if (row.X_WL.has_value() != poses) continue;
    ++counts[row.message];
  }
  const ScanMessage* kept = most_frequent(counts);
  std::erase_if(log.scans, [&](const ScanRow& row) {
    if (row.message == kept) return false;
    log.pass_over(row.message->name, true);
    return true;
  });
}

}  // namespace

void keep_one_laser(ParsedLog& log, const std::string& file) {
  if (log.scans.empty()) return;
  keep_message(log);
  std::map<std::uint32_t, std::size_t> counts;
  for (const ScanRow& row : log.scans) ++counts[row.beams];
  const std::uint32_t beams = most_frequent(counts);
  std::erase_if(log.scans, [&](const ScanRow& row) {
    if (row.beams == beams) return false;
    log.refuse(log.scan_repairs, row.line,
               fmt::format("{}:{}: this scan has {} ranges, {} have {}", file, row.line, row.beams,
                           counts[beams], beams));
    return true;
  });
}

}  // namespace rave::carmen
