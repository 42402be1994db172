// SPDX-License-Identifier: Apache-2.0
#include "foxglove/foxglove_topics.hpp"

#include <fmt/format.h>
#include <sodium.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "foxglove/foxglove_scene.hpp"
#include "foxglove/foxglove_schemas.hpp"
#include "page/page_text.hpp"
#include "rave/base/json_text.hpp"

namespace rave::gui_server {
namespace {

using TopicJson = nlohmann::ordered_json;

/// Names may come from a recording of anybody.
std::string quoted(const std::string& text) { return json_text(TopicJson(text)); }

bool can_be_shown(const RobotState& robot) {
  return (robot.flags & kKnown) != 0 && std::isfinite(robot.x_m) && std::isfinite(robot.y_m) &&
         std::isfinite(robot.yaw_rad) && std::isfinite(robot.speed_mps);
}

const char* flag_word(const RobotState& robot, std::uint16_t flag) {
  return (robot.flags & flag) != 0 ? "true" : "false";
}

std::string base64_of(std::string_view bytes) {
  std::string text(sodium_base64_ENCODED_LEN(bytes.size(), sodium_base64_VARIANT_ORIGINAL), '\0');
  sodium_bin2base64(text.data(), text.size(), reinterpret_cast<const unsigned char*>(bytes.data()),
                    bytes.size(), sodium_base64_VARIANT_ORIGINAL);
  text.pop_back();
  return text;
}

void add_float(std::string& bytes, double value) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  for (unsigned shift = 0; shift < 32; shift += 8) {
    bytes += static_cast<char>((bits >> shift) & 0xffU);
  }
}

/// As `foxglove.Log` counts: 2 info, 3 warning, 4 error.
int log_level(LogEvent::Level level) {
  return level == LogEvent::Level::kInfo ? 2 : (level == LogEvent::Level::kWarn ? 3 : 4);
}

}  // namespace

FoxgloveTopics::FoxgloveTopics(const Source& source, std::uint32_t first_channel)
    : next_(first_channel) {
  for (TopicJson& robot : TopicJson::parse(source.robots_json()))
    robots_.push_back(std::move(robot));
  add(Kind::kTransforms, "/tf", "foxglove.FrameTransforms");
  add(Kind::kScene, "/scene", "foxglove.SceneUpdate");
  add(Kind::kRobots, "/robots", "foxglove.SceneUpdate");
  add(Kind::kPoses, "/poses", "rave.Poses");
  add(Kind::kLog, "/log", "foxglove.Log");
  add(Kind::kRun, "/run", "rave.Run");
  for (std::uint32_t slot = 0; slot < robots_.size(); ++slot) {
    const auto name = robots_[slot].at("name").get<std::string>();
    names_.push_back(quoted(name));
    frames_.push_back(quoted(foxglove_frame(name)));
    add_scans(slot);
  }
}

void FoxgloveTopics::add(Kind kind, const std::string& topic, const char* schema) {
  topics_.push_back({{next_++, topic, schema, foxglove_schema(schema)}, kind, {}});
}

void FoxgloveTopics::add_scans(std::uint32_t slot) {
  const TopicJson& robot = robots_[slot];
  std::uint32_t number = 0;
  for (const TopicJson& sensor : robot.at("sensors")) {
    const LookedAt looked{slot, number++};
    if (sensor.at("kind") != "ranges" || !sensor.contains("bearings")) continue;
    if (scanners_.size() >= kMostScans) {
      ++left_out_;
      continue;
    }
    Scanner scanner;
    scanner.sensor = looked;
    for (std::size_t i = 0; i < 3; ++i) scanner.X_RS[i] = sensor.at("mount").at(i).get<double>();
    scanner.z_m = sensor.at("z").get<double>();
    scanner.bearings_rad = sensor.at("bearings").get<std::vector<double>>();
    scanners_.push_back(std::move(scanner));
    const std::string topic = fmt::format("/scan/{}/{}", robot.at("name").get<std::string>(),
                                          sensor.at("name").get<std::string>());
    add(Kind::kScan, topic, "foxglove.PointCloud");
    topics_.back().sensor = looked;
  }
}

std::vector<FoxgloveChannel> FoxgloveTopics::channels() const {
  std::vector<FoxgloveChannel> channels;
  for (const Topic& topic : topics_) channels.push_back(topic.channel);
  return channels;
}

const FoxgloveTopics::Topic* FoxgloveTopics::topic_of(std::uint32_t channel) const {
  const std::uint32_t index = channel - topics_.front().channel.id;
  return index < topics_.size() ? &topics_[index] : nullptr;
}

std::string FoxgloveTopics::transforms(const PosesAt& poses) const {
  const std::string stamp = foxglove_stamp(poses.time_s).dump();
  std::string text = R"({"transforms":[)";
  const std::size_t count = std::min(frames_.size(), poses.robots.size());
  for (std::size_t slot = 0; slot < count; ++slot) {
    const RobotState& robot = poses.robots[slot];
    if (!can_be_shown(robot)) continue;
    if (text.back() != '[') text += ',';
    fmt::format_to(std::back_inserter(text),
                   R"({{"timestamp":{},"parent_frame_id":"world","child_frame_id":{},)"
                   R"("translation":{{"x":{:.4f},"y":{:.4f},"z":0}},)"
                   R"("rotation":{{"x":0,"y":0,"z":{:.6f},"w":{:.6f}}}}})",
                   stamp, frames_[slot], robot.x_m, robot.y_m, std::sin(robot.yaw_rad / 2),
                   std::cos(robot.yaw_rad / 2));
  }
  return text + "]}";
}

std::string FoxgloveTopics::poses(const PosesAt& poses) const {
  std::string text =
      fmt::format(R"({{"timestamp":{},"robots":[)", foxglove_stamp(poses.time_s).dump());
  const std::size_t count = std::min(names_.size(), poses.robots.size());
  // Robots without a pose have an entry, so that an index means the same robot always.
  for (std::size_t slot = 0; slot < count; ++slot) {
    const bool shown = can_be_shown(poses.robots[slot]);
    const RobotState robot = shown ? poses.robots[slot] : RobotState{};
    if (slot > 0) text += ',';
    fmt::format_to(std::back_inserter(text),
                   R"({{"name":{},"x_m":{:.4f},"y_m":{:.4f},"yaw_rad":{:.5f},"speed_mps":{:.4f},)"
                   R"("known":{},"stale":{},"stopped":{},"real":{},"touching":{}}})",
                   names_[slot], robot.x_m, robot.y_m, robot.yaw_rad, robot.speed_mps,
                   flag_word(robot, kKnown), flag_word(robot, kStale), flag_word(robot, kStopped),
                   flag_word(robot, kReal), flag_word(robot, kTouching));
  }
  return text + "]}";
}

std::string FoxgloveTopics::points(const ReadingAt& reading) const {
  const LookedAt looked{reading.slot, reading.sensor};
  const auto scanner = std::ranges::find(scanners_, looked, &Scanner::sensor);
  if (scanner == scanners_.end() || reading.slot >= robots_.size()) return {};
  std::string bytes;
  const std::size_t rays = std::min(scanner->bearings_rad.size(), reading.values.size());
  for (std::size_t i = 0; i < rays; ++i) {
    const double range_m = reading.values[i];
    if (!std::isfinite(range_m)) continue;
    add_float(bytes, range_m * std::cos(scanner->bearings_rad[i]));
    add_float(bytes, range_m * std::sin(scanner->bearings_rad[i]));
    add_float(bytes, 0);
  }
  // The number of 32 bit floating point among the types of a field.
  constexpr int kFloat32 = 7;
  const TopicJson message = {
      {"timestamp", foxglove_stamp(reading.stamp_s)},
      {"frame_id", foxglove_frame(robots_[reading.slot].at("name").get<std::string>())},
      {"pose", foxglove_pose(scanner->X_RS[0], scanner->X_RS[1], scanner->z_m, scanner->X_RS[2])},
      {"point_stride", 12},
      {"fields",
       {{{"name", "x"}, {"offset", 0}, {"type", kFloat32}},
        {{"name", "y"}, {"offset", 4}, {"type", kFloat32}},
        {{"name", "z"}, {"offset", 8}, {"type", kFloat32}}}},
      {"data", base64_of(bytes)}};
  return json_text(message);
}

std::string FoxgloveTopics::log(const LogEvent& event) {
  const TopicJson message = {{"timestamp", foxglove_stamp(event.t_s)},
                             {"level", log_level(event.level)},
                             {"message", event.text},
                             {"name", event.kind},
                             {"file", ""},
                             {"line", 0}};
  return json_text(message);
}

std::string FoxgloveTopics::run(const PlayState& state) {
  const TopicJson message = {{"timestamp", foxglove_stamp(state.now_s)},
                             {"time_s", state.now_s},
                             {"state", kStateWords.of(state.kind)},
                             {"pace", state.pace},
                             {"speed", state.speed}};
  return json_text(message);
}

}  // namespace rave::gui_server
