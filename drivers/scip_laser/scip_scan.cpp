// SPDX-License-Identifier: Apache-2.0
#include "scip_laser/scip_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scip_laser/scip_code.hpp"

namespace rave::scip {
namespace {

constexpr std::size_t kBlock = 64;  ///< Characters of data in one line.
constexpr std::size_t kTimer = 4;

/// Whether the lines after the first contain `characters` characters in full blocks.
bool has_shape(const Reply& reply, std::size_t characters) noexcept {
  const std::size_t blocks = (characters + kBlock - 1) / kBlock;
  if (reply.lines.size() != 1 + blocks || reply.lines[0].size() != kTimer) return false;
  for (std::size_t i = 0; i < blocks; ++i) {
    if (reply.lines[1 + i].size() != std::min(kBlock, characters - i * kBlock)) return false;
  }
  return true;
}

float range_of(std::uint32_t value_mm, const ScanRequest& request) noexcept {
  const auto mm = static_cast<std::int32_t>(value_mm);
  // The largest encodable number means "at least that far".
  const bool saturated =
      value_mm + 1 == 1U << (6U * static_cast<std::uint32_t>(request.characters));
  if (saturated || mm > request.range_max_mm) return std::numeric_limits<float>::infinity();
  const auto range_min_m = static_cast<float>(request.range_min_mm) * 1e-3F;
  if (mm < kLeastRange_mm) return range_of_code(mm, request.codes, range_min_m);
  return std::max(static_cast<float>(mm) * 1e-3F, range_min_m);
}

/// A range may be split between two blocks.
bool read_ranges(const Reply& reply, const ScanRequest& request, Scan& scan) {
  scan.ranges_m.clear();
  std::uint32_t value = 0;
  std::int32_t have = 0;
  for (std::size_t i = 1; i < reply.lines.size(); ++i) {
    for (const char& c : reply.lines[i]) {
      const auto digit = decode(std::string_view(&c, 1));
      if (!digit) return false;
      value = (value << 6) | *digit;
      if (++have < request.characters) continue;
      scan.ranges_m.push_back(range_of(value, request));
      value = 0;
      have = 0;
    }
  }
  return true;
}

/// The echo repeats the command; in continuous mode it may contain the number of remaining scans.
bool echoes(std::string_view echo, const ScanRequest& request) {
  const std::string command = request.command();
  if (!request.continuous) return echo == command;
  return echo.size() == command.size() &&
         echo.substr(0, echo.size() - 2) == std::string_view(command).substr(0, echo.size() - 2);
}

}  // namespace

bool Scan::sees() const noexcept {
  return std::any_of(ranges_m.begin(), ranges_m.end(),
                     [](float range_m) { return !std::isnan(range_m); });
}

std::string ScanRequest::command() const {
  const char* const encoding = characters == 2 ? "S" : "D";
  if (continuous) {
    return fmt::format("M{}{:04}{:04}01{}00", encoding, first_step, last_step, skipped_scans);
  }
  return fmt::format("G{}{:04}{:04}01", encoding, first_step, last_step);
}

ScanEnd read_scan(const Reply& reply, const ScanRequest& request, Scan& scan) {
  if (!echoes(reply.echo, request)) return ScanEnd::kNoScan;
  const bool accepted = reply.status == "00";
  if (!accepted && reply.status != "99") return ScanEnd::kRefused;
  // In continuous mode "00" acknowledges the command, and each scan has the status "99". A polled
  // scan has "00".
  if (request.continuous && accepted) {
    return reply.lines.empty() ? ScanEnd::kNoScan : ScanEnd::kMalformed;
  }
  const std::size_t characters =
      std::size_t{request.size()} * static_cast<std::size_t>(request.characters);
  if (!has_shape(reply, characters)) return ScanEnd::kMalformed;
  const auto timer_ms = decode(reply.lines[0]);
  if (!timer_ms || !read_ranges(reply, request, scan)) return ScanEnd::kMalformed;
  scan.timer_ms = *timer_ms;
  return ScanEnd::kScan;
}

std::string describe_status(std::string_view status) {
  const auto is_number = [](char c) { return c >= '0' && c <= '9'; };
  std::string_view meaning = "unknown command or parameter";
  if (status.size() == 2 && is_number(status[0]) && is_number(status[1])) {
    const int code = (status[0] - '0') * 10 + (status[1] - '0');
    if (code <= 7) meaning = "a parameter of the command is wrong";
    if (code == 10) meaning = "the laser is off";
    if (code >= 21 && code <= 49) meaning = "measuring stopped to check an error";
    if (code >= 50 && code <= 97) meaning = "hardware trouble";
    if (code == 98) meaning = "measurement continues after a check of the laser";
  }
  return fmt::format("status {} ({})", status, meaning);
}

}  // namespace rave::scip
