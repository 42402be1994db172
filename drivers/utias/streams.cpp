// SPDX-License-Identifier: Apache-2.0
#include "utias/streams.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace rave::utias {
namespace {

using recording::describe;
using recording::drop_duplicates;
using recording::sort_rows;
using recording::trim;
using recording::wrap_heading;

// Columns of the logs as the data set documents them; the names appear in messages about a bad row.
constexpr std::array<Column, 4> kPoseColumns{{{"time [s]", ColumnKind::kStamp},
                                              {"x [m]", ColumnKind::kReal},
                                              {"y [m]", ColumnKind::kReal},
                                              {"orientation [rad]", ColumnKind::kReal}}};
constexpr std::array<Column, 3> kOdometryColumns{{{"time [s]", ColumnKind::kStamp},
                                                  {"forward velocity [m/s]", ColumnKind::kReal},
                                                  {"angular velocity [rad/s]", ColumnKind::kReal}}};
constexpr std::array<Column, 4> kSightingColumns{{{"time [s]", ColumnKind::kStamp},
                                                  {"barcode", ColumnKind::kCode},
                                                  {"range [m]", ColumnKind::kNonNegative},
                                                  {"bearing [rad]", ColumnKind::kReal}}};
constexpr std::array<Column, 2> kBarcodeColumns{
    {{"subject", ColumnKind::kCode}, {"barcode", ColumnKind::kCode}}};
constexpr std::array<Column, 5> kLandmarkColumns{{{"subject", ColumnKind::kCode},
                                                  {"x [m]", ColumnKind::kReal},
                                                  {"y [m]", ColumnKind::kReal},
                                                  {"x std-dev [m]", ColumnKind::kNonNegative},
                                                  {"y std-dev [m]", ColumnKind::kNonNegative}}};

// Gaps above these are listed in the reports.
constexpr std::int64_t kPoseGap_ns = 150'000'000;
constexpr std::int64_t kOdometryGap_ns = 200'000'000;
constexpr std::int64_t kSightingGap_ns = 5'000'000'000;

StreamReport begin_report(LogFile& file, int robot, StreamKind kind, std::int64_t gap_limit_ns) {
  StreamReport report;
  static_cast<recording::LogIdentity&>(report) = std::move(file.identity);
  report.robot = robot;
  report.kind = kind;
  report.repairs = std::move(file.log.repairs);
  report.gap_limit_ns = gap_limit_ns;
  return report;
}

/// The stream of a state that holds until the next row: one row per stamp, in order, described for
/// the report as the log has them, and cut to the window last. `convert(row, t_ns, report)` gives a
/// sample.
template <class Sample, class Convert>
Stream<Sample> make_states(LogFile file, StreamReport report, const StreamWindow& window,
                           Convert convert) {
  Stream<Sample> stream{{}, std::move(report)};
  sort_rows(file.log.rows, stream.report);
  drop_duplicates(file.log.rows, window, stream.report);
  stream.samples.reserve(file.log.rows.size());
  for (const LogRow& row : file.log.rows) {
    stream.samples.push_back(convert(row, row.stamp_ns - window.origin_ns, stream.report));
  }
  describe(stream.report, stream.samples, window);
  trim(stream.samples, window);
  return stream;
}

void count_unknown(StreamReport& report, const std::vector<Sighting>& sightings) {
  std::map<int, std::int64_t> counts;
  for (const Sighting& sighting : sightings) {
    if (sighting.subject == kUnknownSubject) ++counts[sighting.code];
  }
  for (const auto& [code, count] : counts) report.unknown_codes.push_back({code, count});
}

// The number in the measurement log is a barcode. Reading it as a subject is the classical mistake
// with this data set, offered so that a check can be shown to notice it.
int subject_of(int code, CodeMeaning meaning, const Subjects& subjects) noexcept {
  if (meaning == CodeMeaning::kBarcode) return subjects.subject_of_code(code);
  return subjects.code_of_subject(code) >= 0 ? code : kUnknownSubject;
}

}  // namespace

std::span<const Column> pose_columns() noexcept { return kPoseColumns; }
std::span<const Column> odometry_columns() noexcept { return kOdometryColumns; }
std::span<const Column> sighting_columns() noexcept { return kSightingColumns; }
std::span<const Column> barcode_columns() noexcept { return kBarcodeColumns; }
std::span<const Column> landmark_columns() noexcept { return kLandmarkColumns; }

Stream<PoseSample> make_poses(LogFile file, int robot, const StreamWindow& window) {
  StreamReport report = begin_report(file, robot, StreamKind::kPoses, kPoseGap_ns);
  return make_states<PoseSample>(
      std::move(file), std::move(report), window,
      [](const LogRow& row, std::int64_t t_ns, StreamReport& told) {
        PoseSample sample{t_ns, {row.reals[0], row.reals[1], row.reals[2]}};
        wrap_heading(sample.pose, row.line, told);
        return sample;
      });
}

Stream<OdometrySample> make_odometry(LogFile file, int robot, const StreamWindow& window) {
  StreamReport report = begin_report(file, robot, StreamKind::kOdometry, kOdometryGap_ns);
  return make_states<OdometrySample>(std::move(file), std::move(report), window,
                                     [](const LogRow& row, std::int64_t t_ns, StreamReport&) {
                                       return OdometrySample{t_ns, row.reals[0], row.reals[1]};
                                     });
}

Stream<Sighting> make_sightings(LogFile file, int robot, const StreamWindow& window,
                                std::int64_t clock_offset_ns, CodeMeaning meaning,
                                const Subjects& subjects) {
  Stream<Sighting> stream;
  stream.report = begin_report(file, robot, StreamKind::kSightings, kSightingGap_ns);
  sort_rows(file.log.rows, stream.report);
  for (const LogRow& row : file.log.rows) {
    const int code = row.codes[0];
    // Several sightings of one image have the same stamp, so duplicates are kept here.
    stream.samples.push_back({row.stamp_ns - window.origin_ns + clock_offset_ns, code,
                              subject_of(code, meaning, subjects), row.reals[0], row.reals[1]});
  }
  describe(stream.report, stream.samples, window);
  // Not trim(), which keeps the last state before the window: a sighting is an event and not a
  // state.
  std::erase_if(stream.samples, [&](const Sighting& sighting) {
    return sighting.t_ns < window.start_ns || sighting.t_ns > window.end_ns;
  });
  count_unknown(stream.report, stream.samples);
  return stream;
}

}  // namespace rave::utias
