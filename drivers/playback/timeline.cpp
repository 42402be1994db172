// SPDX-License-Identifier: Apache-2.0
#include "playback/timeline.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "rave/base/named_path.hpp"
#include "rave/record/run_reader.hpp"

namespace rave::playback {
namespace {

using ByteSpan = std::span<const std::byte>;

/// The new readings of an event sensor. Until the program decides, a percept contains the events of
/// all steps since the last decision, so those of the previous percept are removed. Each sighting
/// has its own stamp, so equal bytes are the same sighting.
ByteSpan new_events(ByteSpan before, ByteSpan now) {
  const bool grown = now.size() > before.size() && !before.empty() &&
                     std::memcmp(now.data(), before.data(), before.size()) == 0;
  return grown ? now.subspan(before.size()) : now;
}

/// Shifts the stamps inside sightings.
void shift_sightings(std::span<std::byte> records, std::int64_t by_ns) {
  for (std::size_t at = 0; at + sizeof(Sighting) <= records.size(); at += sizeof(Sighting)) {
    Sighting sighting;
    std::memcpy(&sighting, records.data() + at, sizeof sighting);
    sighting.stamp_ns += by_ns;
    std::memcpy(records.data() + at, &sighting, sizeof sighting);
  }
}

/// Collects samples from the start time on, in order.
class Builder {
 public:
  Builder(ReadingKind kind, double start_s)
      : size_(record_size(kind)),
        events_(kind == ReadingKind::kSightings),
        start_(from_seconds(start_s)) {}

  void add(SimTime stamp, SimTime delivered, ByteSpan records) {
    SimTime at = stamp - start_;
    if (at.ns < 0) {
      if (events_) return;
      // For a state sensor, the last sample before the start applies from the first step on.
      at = {};
      timeline_.groups.clear();
      timeline_.records.clear();
    }
    auto& groups = timeline_.groups;
    // The stamps of a sensor must not decrease.
    if (!groups.empty() && at < groups.back().stamp) {
      ++timeline_.left_out;
      return;
    }
    const std::size_t offset = timeline_.records.size();
    timeline_.records.insert(timeline_.records.end(), records.begin(), records.end());
    if (events_ && start_.ns != 0) {
      shift_sightings(std::span(timeline_.records).subspan(offset), -start_.ns);
    }
    const auto count = static_cast<std::uint32_t>(records.size() / size_);
    // A reading cannot be delivered before its stamp.
    groups.push_back({at, std::max(at, delivered - start_), offset, count});
  }
  [[nodiscard]] Timeline finish() && { return std::move(timeline_); }

 private:
  std::size_t size_;
  bool events_;
  Duration start_;
  Timeline timeline_;
};

Result<Timeline> reported_poses(const record::McapReader& reader, RobotId robot, double start_s) {
  RAVE_TRY_ASSIGN(const auto track, record::read_poses(reader, robot));
  Builder builder(ReadingKind::kPose, start_s);
  for (const record::PoseTrackPoint& point : track) {
    if (!point.reported_pose) continue;
    const Pose2& X_WR = *point.reported_pose;
    const PoseReading reading{X_WR.x, X_WR.y, X_WR.yaw, 0, 0};
    builder.add(point.time, point.time, std::as_bytes(std::span(&reading, 1)));
  }
  return std::move(builder).finish();
}

Status check_sensor(const record::RecordedSensor& sensor, ReadingKind kind,
                    const Timeline& timeline) {
  if (kind == ReadingKind::kRanges && timeline.largest_group() > sensor.bearings_rad.size()) {
    return fail(ErrorCode::kParse, "sensor `{}` has readings of {} rays, but bearings of {}",
                sensor.name, timeline.largest_group(), sensor.bearings_rad.size());
  }
  return {};
}

Result<Timeline> sensor_readings(const record::McapReader& reader, const record::RunInfo& run,
                                 const record::RecordedRobot& robot, const Source& source,
                                 ReadingKind kind) {
  RAVE_TRY_ASSIGN(const auto* const sensor, record::find_sensor(run, robot, source.sensor));
  const auto recorded = static_cast<ReadingKind>(sensor->kind);
  if (recorded != kind) {
    return fail(ErrorCode::kInvalidArgument,
                "sensor `{}` of robot `{}` gives {}, so its driver is `playback_{}`, not "
                "`playback_{}`",
                source.sensor, source.robot, to_string(recorded), to_string(recorded),
                to_string(kind));
  }
  RAVE_TRY_ASSIGN(const auto all,
                  record::read_samples(reader, robot.id, sensor->sensor, source.part));
  Builder builder(kind, source.start_s);
  ByteSpan before;
  for (const auto& sample : all.samples) {
    const ByteSpan now = all.records_of(sample);
    builder.add({sample.header.stamp_ns}, sample.delivered,
                source.collect ? new_events(before, now) : now);
    before = now;
  }
  Timeline timeline = std::move(builder).finish();
  RAVE_TRY(check_sensor(*sensor, kind, timeline));
  timeline.info = *sensor;
  return timeline;
}

}  // namespace

Source source_of(const Params& params, ReadingKind kind) {
  Source source;
  source.file = params.text("file");
  source.robot = params.text("robot");
  source.sensor = params.text("sensor");
  const std::string_view part = params.text("part");
  if (part == "real") source.part = record::PerceptPart::kReal;
  if (part == "virtual") source.part = record::PerceptPart::kVirtual;
  source.start_s = params.number("start_s");
  source.live = params.text("clock") == "live";
  source.collect = kind == ReadingKind::kSightings && params.flag("collect");
  return source;
}

Result<Timeline> load_timeline(const Source& source, const std::string& folder, ReadingKind kind) {
  const std::filesystem::path path = named_path(folder, source.file);
  const auto load = [&]() -> Result<Timeline> {
    RAVE_TRY_ASSIGN(const auto reader, record::McapReader::open(path));
    RAVE_TRY_ASSIGN(const record::RunInfo run, record::read_run_info(reader));
    RAVE_TRY_ASSIGN(const auto* const robot, record::find_robot(run, source.robot));
    if (kind == ReadingKind::kPose && source.sensor.empty()) {
      return reported_poses(reader, robot->id, source.start_s);
    }
    return sensor_readings(reader, run, *robot, source, kind);
  };
  auto timeline = load();
  if (timeline) return timeline;
  return tl::unexpected(std::move(timeline).error().with_context(
      fmt::format("record `{}`", path.lexically_normal().string())));
}

std::string report_json(const Source& source, const Timeline& timeline) {
  // Division instead of multiplication by 1e-9, so that whole milliseconds print exactly.
  const auto seconds = [](SimTime t) { return static_cast<double>(t.ns) / 1e9; };
  nlohmann::ordered_json json;
  json["file"] = source.file;
  json["robot"] = source.robot;
  json["sensor"] = source.sensor;
  json["start_s"] = source.start_s;
  json["samples"] = timeline.groups.size();
  json["left_out"] = timeline.left_out;
  json["dropped"] = {{"count", timeline.left_out},
                     {"of", timeline.groups.size() + timeline.left_out},
                     {"because", timeline.left_out > 0 ? "stamps that step back" : ""}};
  json["first_stamp_s"] = nullptr;
  json["last_stamp_s"] = nullptr;
  if (!timeline.groups.empty()) {
    json["first_stamp_s"] = seconds(timeline.groups.front().stamp);
    json["last_stamp_s"] = seconds(timeline.groups.back().stamp);
  }
  // File names may not be UTF-8, which JSON requires.
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace rave::playback
