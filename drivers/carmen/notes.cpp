// SPDX-License-Identifier: Apache-2.0
#include "carmen/notes.hpp"

#include <fmt/format.h>

#include <utility>

namespace rave::carmen {
namespace {

using recording::RepairKind;

std::string unknown_messages(const Log& log) {
  std::string text;
  for (const PassedOver& other : log.passed_over) {
    if (other.known) continue;
    text += fmt::format("{}{} x {}", text.empty() ? "" : ", ", other.count, other.name);
  }
  return text;
}

}  // namespace

std::vector<std::string> notes(const Log& log, std::string_view path,
                               const recording::StreamReport& report) {
  std::vector<std::string> notes;
  const auto note = [&](std::string text) {
    notes.push_back(fmt::format("log `{}`: {}", path, std::move(text)));
  };
  if (const std::string unknown = unknown_messages(log); !unknown.empty()) {
    note(fmt::format("passed over rows of unknown messages: {}", unknown));
  }
  const std::int64_t refused = log.scan_report.repaired(RepairKind::kRefusedRow) +
                               log.odometry_report.repaired(RepairKind::kRefusedRow);
  if (refused > 0) {
    const std::string why = log.refusals.empty() ? std::string() : log.refusals.front();
    note(fmt::format("refused {} rows, the first: {}", refused, why));
  }
  if (log.stamped_by == StampedBy::kLogger && log.mixed_clocks) {
    note("the stamps are those of the logger, because those of the messages are of several clocks");
  }
  if (const std::int64_t count = report.repaired(RepairKind::kOtherClock); count > 0) {
    note(fmt::format("dropped {} rows with stamps of another clock", count));
  }
  if (const std::int64_t count = report.repaired(RepairKind::kStepBack); count > 0) {
    note(fmt::format("sorted {} rows with stamps out of order", count));
  }
  if (log.unknown_rays > 0) {
    note(fmt::format("{} ranges are NaN or negative, that is not known", log.unknown_rays));
  }
  if (log.maximum_m > 0) {
    note(
        fmt::format("ranges from {:g} m on are taken for no return, because it is the "
                    "maximum_range of the rows",
                    log.maximum_m));
  }
  if (log.no_return) {
    note(fmt::format(
        "{} rays ({:.1f} %) have a range of exactly {:g} m, which is taken for no "
        "return; `no_return_m` says otherwise",
        log.no_return->rays,
        100 * static_cast<double>(log.no_return->rays) / static_cast<double>(log.no_return->of),
        log.no_return->range_m));
  }
  return notes;
}

}  // namespace rave::carmen
