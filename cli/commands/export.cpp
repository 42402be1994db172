// SPDX-License-Identifier: Apache-2.0
#include "commands/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>

#include "error_text.hpp"
#include "places.hpp"
#include "rave/record/mcap_reader.hpp"
#include "rave/record/run_reader.hpp"
#include "rave/robot/reading_type.hpp"

namespace rave::cli {
namespace {

/// Where lines go. One thread; the first failure to write is kept for close().
class CsvFile {
 public:
  static Result<CsvFile> open(const std::string& path) {
    if (path.empty()) return CsvFile(stdout);
    std::FILE* const file = std::fopen(path.c_str(), "we");
    if (file == nullptr) {
      return fail(ErrorCode::kIo, "cannot write `{}`: {}", path, std::strerror(errno));
    }
    return CsvFile(file);
  }

  void line(std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), file_.get());
    std::fputc('\n', file_.get());
  }
  /// Errors: kIo, as for a disk that is full.
  Status close() {
    // The buffer is written here at last, so a full disk often shows only now.
    const bool bad = std::fflush(file_.get()) != 0 || std::ferror(file_.get()) != 0;
    if (bad) return fail(ErrorCode::kIo, "cannot write the output: {}", std::strerror(errno));
    return {};
  }

 private:
  struct Closer {
    void operator()(std::FILE* file) const noexcept {
      if (file != stdout) std::fclose(file);
    }
  };
  explicit CsvFile(std::FILE* file) : file_(file) {}
  std::unique_ptr<std::FILE, Closer> file_;
};

double seconds(std::int64_t ns) { return SimTime{ns}.seconds(); }

std::string csv_text(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + '"';
}

std::string pose_text(const std::optional<Pose2>& pose) {
  return pose ? fmt::format("{},{},{}", pose->x, pose->y, pose->yaw) : ",,";
}

std::string name_of(const record::RunInfo& run, RobotId id) {
  return id.value() < run.robots.size() ? run.robots[id.value()].name : std::string();
}

Status export_poses(const record::McapReader& reader, const record::RunInfo& run,
                    const std::optional<RobotId>& only, CsvFile& out) {
  out.line("time_s,robot,x_m,y_m,yaw_rad,true_x_m,true_y_m,true_yaw_rad,vx_mps,vy_mps,wz_radps");
  return record::for_each_message(
      reader, record::topic::kPoses, [&](const record::MessageView& message) -> Status {
        RAVE_TRY_ASSIGN(const auto step, record::decode_poses(message.bytes));
        for (const record::RobotPose& pose : step.items) {
          if (only && pose.robot != *only) continue;
          // Nine digits keep the nanosecond grid of steps readable: 0.1 and not
          // 0.10000000000000001.
          out.line(fmt::format("{:.9g},{},{},{},{},{},{}", seconds(step.time.ns),
                               name_of(run, pose.robot), pose_text(pose.reported_pose),
                               pose_text(pose.true_pose), pose.velocity_W.vx, pose.velocity_W.vy,
                               pose.velocity_W.wz));
        }
        return {};
      });
}

Status export_events(const record::McapReader& reader, const record::RunInfo& run,
                     const std::optional<RobotId>& only, CsvFile& out) {
  out.line("time_s,robot,kind,text");
  return record::for_each_message(
      reader, record::topic::kEvents, [&](const record::MessageView& message) -> Status {
        RAVE_TRY_ASSIGN(const auto step, record::decode_event(message.bytes));
        for (const record::RunEvent& event : step.items) {
          if (only && event.robot != *only) continue;
          out.line(fmt::format("{:.9g},{},{},{}", seconds(step.time.ns), name_of(run, event.robot),
                               event.kind, csv_text(event.text)));
        }
        return {};
      });
}

bool has_one_row(ReadingKind kind) { return reading_type(kind).shape == ReadingShape::kSeries; }

/// The columns of a kind of reading behind `time_s,stamp_s`; a series has one per record.
std::string columns_of(ReadingKind kind, std::size_t most) {
  std::string text;
  const auto add = [&text](std::string_view name) {
    if (!text.empty()) text += ',';
    text += name;
  };
  for (std::size_t i = 0; i < (has_one_row(kind) ? most : 1); ++i) {
    for (const ReadingField& field : reading_type(kind).columns) {
      add(has_one_row(kind) ? fmt::format("{}_{}", field.name, i) : std::string(field.name));
    }
  }
  return text;
}

/// The rows of one sample, each behind `front`.
void write_sample(ReadingKind kind, const std::string& front, std::span<const std::byte> bytes,
                  CsvFile& out) {
  const ReadingType& type = reading_type(kind);
  const std::size_t size = type.record_bytes;
  std::string row;
  for (std::size_t at = 0; size > 0 && at + size <= bytes.size(); at += size) {
    for (const ReadingField& field : type.columns) {
      with_number(field, bytes.data() + at, [&row](auto number) {
        row += fmt::format("{}{}", row.empty() ? "" : ",", number);
      });
    }
    if (has_one_row(kind) && at + 2 * size <= bytes.size()) continue;
    out.line(front + row);
    row.clear();
  }
}

Status export_readings(const record::McapReader& reader, const record::RunInfo& run,
                       const ExportCommand& options, CsvFile& out) {
  RAVE_TRY_ASSIGN(const auto* robot, record::find_robot(run, options.robot));
  RAVE_TRY_ASSIGN(const auto* sensor, record::find_sensor(run, *robot, options.sensor));
  RAVE_TRY_ASSIGN(const auto samples, record::read_samples(reader, robot->id, sensor->sensor,
                                                           record::PerceptPart::kResult));
  const auto kind = static_cast<ReadingKind>(sensor->kind);
  std::size_t most = 0;
  for (const auto& sample : samples.samples) {
    // Sensors may give fewer readings at times; the header needs the most.
    most = std::max<std::size_t>(most, sample.header.count);
  }
  out.line("time_s,stamp_s," + columns_of(kind, most));
  for (const auto& sample : samples.samples) {
    const std::string front = fmt::format("{:.9g},{:.9g},", seconds(sample.delivered.ns),
                                          seconds(sample.header.stamp_ns));
    const std::size_t valid = sample.header.count * std::size_t{record_size(kind)};
    const auto bytes = samples.records_of(sample);
    if (sample.header.count > 0)
      write_sample(kind, front, bytes.first(std::min(valid, bytes.size())), out);
  }
  return {};
}

Status write_csv(const ExportCommand& options) {
  if (options.what == "readings" && (options.robot.empty() || options.sensor.empty())) {
    return fail(ErrorCode::kInvalidArgument, "readings: expected --robot NAME and --sensor NAME");
  }
  if (options.what != "readings" && !options.sensor.empty()) {
    return fail(ErrorCode::kInvalidArgument, "--sensor: expected only with readings");
  }
  RAVE_TRY_ASSIGN(const auto file, record_file(options.file));
  RAVE_TRY_ASSIGN(const auto reader, record::McapReader::open(file));
  RAVE_TRY_ASSIGN(const auto run, record::read_run_info(reader));
  std::optional<RobotId> only;
  if (!options.robot.empty()) {
    RAVE_TRY_ASSIGN(const auto* robot, record::find_robot(run, options.robot));
    only = robot->id;
  }
  // Opened last, so that a wrong name does not empty an existing file.
  RAVE_TRY_ASSIGN(auto out, CsvFile::open(options.output));
  if (options.what == "poses") {
    RAVE_TRY(export_poses(reader, run, only, out));
  } else if (options.what == "events") {
    RAVE_TRY(export_events(reader, run, only, out));
  } else {
    RAVE_TRY(export_readings(reader, run, options, out));
  }
  return out.close();
}

}  // namespace

Result<int> export_recording(const ExportCommand& options) {
  RAVE_TRY(write_csv(options));
  return kGood;
}

}  // namespace rave::cli
