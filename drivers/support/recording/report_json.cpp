// SPDX-License-Identifier: Apache-2.0
#include "recording/report_json.hpp"

#include <nlohmann/json.hpp>
#include <optional>

#include "rave/base/word_table.hpp"

namespace rave::recording {
namespace {

using Json = nlohmann::ordered_json;

constexpr WordTable<RepairKind, 7> kRepairs = {{{"duplicate_stamp", RepairKind::kDuplicateStamp},
                                                {"step_back", RepairKind::kStepBack},
                                                {"heading_wrapped", RepairKind::kHeadingWrapped},
                                                {"cut_line", RepairKind::kCutLine},
                                                {"junk_stamp", RepairKind::kJunkStamp},
                                                {"refused_row", RepairKind::kRefusedRow},
                                                {"other_clock", RepairKind::kOtherClock}}};
constexpr WordTable<GapKind, 3> kGaps = {{{"inside", GapKind::kInside},
                                          {"late_start", GapKind::kLateStart},
                                          {"early_end", GapKind::kEarlyEnd}}};

/// Division instead of multiplication by 1e-9, so that whole milliseconds print exactly.
double seconds(std::int64_t ns) { return static_cast<double>(ns) / 1e9; }

Json stamp(const std::optional<std::int64_t>& ns) { return ns ? Json(seconds(*ns)) : Json(); }

Json gaps_of(const StreamReport& report) {
  Json list = Json::array();
  for (const Gap& gap : report.gaps) {
    list.push_back({{"start_s", seconds(gap.start_ns)},
                    {"length_s", seconds(gap.length_ns)},
                    {"kind", kGaps.of(gap.kind)}});
  }
  return list;
}

Json repairs_of(const StreamReport& report) {
  Json list = Json::array();
  for (const Repair& repair : report.repairs) {
    list.push_back({{"what", kRepairs.of(repair.kind)},
                    {"count", repair.count},
                    {"first_line", repair.first_line}});
  }
  return list;
}

/// The part that robot_host evaluates; see README.md.
Json dropped_of(const StreamReport& report) {
  std::string because;
  for (const Repair& repair : report.repairs) {
    const bool drops = repair.kind == RepairKind::kDuplicateStamp ||
                       repair.kind == RepairKind::kRefusedRow ||
                       repair.kind == RepairKind::kOtherClock ||
                       (repair.kind == RepairKind::kJunkStamp && report.rows == 0);
    if (drops) because += (because.empty() ? "" : ", ") + std::string(kRepairs.of(repair.kind));
  }
  const std::int64_t count = report.dropped();
  return {{"count", count}, {"of", report.rows + count}, {"because", because}};
}

}  // namespace

void add_file(Json& json, const StreamReport& report) {
  json["file"] = report.file;
  json["sha256"] = report.sha256;
  json["unchanged"] = report.unchanged ? Json(*report.unchanged) : Json();
  json["beside"] = report.beside;
}

void add_timing(Json& json, const StreamReport& report, const Window& window) {
  json["start_s"] = seconds(window.start_ns);
  json["end_s"] = seconds(window.end_ns);
  json["clock_offset_s"] = window.clock_offset_s;
  json["first_stamp_s"] = stamp(report.first_ns);
  json["last_stamp_s"] = stamp(report.last_ns);
  json["rows"] = report.rows;
  json["stamps"] = report.stamps;
  json["rate_hz"] = report.mean_rate_hz;
  json["gap_limit_s"] = seconds(report.gap_limit_ns);
  json["gaps"] = gaps_of(report);
  json["largest_age_s"] = seconds(report.largest_age_ns);
  json["repairs"] = repairs_of(report);
  json["dropped"] = dropped_of(report);
}

std::string text_of(const Json& json) {
  // Folder names may not be UTF-8, which JSON requires.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace rave::recording
