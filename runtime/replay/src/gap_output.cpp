// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "rave/replay/gap.hpp"
#include "rave/report/picture.hpp"

namespace rave::runtime {
namespace {

using Json = nlohmann::ordered_json;

/// Points of a picture closer in time than this are indistinguishable.
constexpr Duration kPictureStep = from_seconds(0.1);

Json json_of(const GapAt& gap) {
  return {{"after_s", gap.after_s}, {"m", gap.metres}, {"deg", gap.degrees}};
}

}  // namespace

std::string gap_json(const GapReport& report) {
  Json json;
  json["robot"] = report.robot;
  json["twin"] = report.twin;
  json["commands"] = report.commands;
  json["pose"] = report.pose;
  json["start_s"] = report.start_s;
  json["duration_s"] = report.duration_s;
  json["driven_m"] = report.driven_m;
  json["after"] = Json::array();
  for (const GapAt& gap : report.after) json["after"].push_back(json_of(gap));
  json["largest"] = json_of(report.largest);
  json["largest_deg"] = report.largest_deg;
  json["rms_m"] = report.rms_m;
  json["rms_deg"] = report.rms_deg;
  json["steps"] = report.steps;
  json["steps_with_pose"] = report.points.size();
  const GapWindows& windows = report.windows;
  const auto known = [&windows](double value) { return windows.count > 0 ? Json(value) : Json(); };
  json["windows"] = {{"window_s", windows.window_s},
                     {"count", windows.count},
                     {"median_m", known(windows.median_m)},
                     {"p95_m", known(windows.p95_m)},
                     {"median_deg", known(windows.median_deg)},
                     {"p95_deg", known(windows.p95_deg)}};
  // Text that is not valid UTF-8, such as a file name, is replaced instead of raising an exception.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Status draw_gap(const GapReport& report, const std::filesystem::path& folder,
                const std::string& stem) {
  report::Picture picture;
  picture.title = fmt::format("{} and its simulated twin", report.robot);
  picture.subtitle = fmt::format("the same commands for {:.1f} s", report.duration_s);
  report::PictureTrack robot;
  robot.label = report.robot;
  robot.kind = report::Kind::kRecordedRobot;
  report::PictureTrack twin;
  twin.label = "twin";
  twin.kind = report::Kind::kSimulatedRobot;
  SimTime next{INT64_MIN};
  SimTime before = report.points.front().time;
  for (const GapReport::Point& point : report.points) {
    const bool last = &point == &report.points.back();
    // The points follow each other by steps, so a longer interval means that the pose was unknown.
    if (point.time - before > kPictureStep) {
      robot.gaps.push_back({before.seconds(), point.time.seconds()});
    }
    before = point.time;
    if (point.time < next && !last) continue;
    next = point.time + kPictureStep;
    robot.points.push_back({point.time.seconds(), point.X_WR});
    twin.points.push_back({point.time.seconds(), point.X_WT});
  }
  picture.tracks = {std::move(robot), std::move(twin)};
  picture.caption = {
      fmt::format("Twin: {}. Commands: {}. Pose of the robot: {}.", report.twin, report.commands,
                  report.pose),
      fmt::format("Largest distance {:.3f} m after {:.1f} s; RMS {:.3f} m and {:.2f} degrees.",
                  report.largest.metres, report.largest.after_s, report.rms_m, report.rms_deg)};
  RAVE_TRY(report::write_svg(picture, folder / (stem + ".svg")));
  return report::write_png(picture, folder / (stem + ".png"));
}

}  // namespace rave::runtime
