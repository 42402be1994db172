// SPDX-License-Identifier: Apache-2.0
// From values to CDR, in the layouts that ros_schemas.cpp describes. A change of a layout with
// packed arrays needs another kLayoutVersion.
#include "encode.hpp"

#include "cdr_time.hpp"
#include "packed.hpp"

namespace rave::record {
void encode_step_head(CdrWriter& writer, SimTime time, std::uint64_t step, std::size_t count) {
  writer.clear();
  put_time(writer, time);
  writer.put(step);
  // Also aligns the packed array behind the count to 8 bytes.
  writer.put(kLayoutVersion);
  writer.put_count(count);
}

void encode_event(CdrWriter& writer, SimTime time, std::uint64_t step, const RunEvent& event) {
  writer.clear();
  put_time(writer, time);
  writer.put(step);
  writer.put(event.robot.value());
  writer.put_string(event.kind);
  writer.put_string(event.text);
  writer.put_sequence(std::span<const double>(event.values));
}

void encode_variances(CdrWriter& writer, SimTime time, std::uint64_t step,
                      std::span<const PoseVariance> robots) {
  encode_step_head(writer, time, step, robots.size());
  for (const PoseVariance& robot : robots) {
    writer.put(robot.robot.value());
    // Aligns the doubles of the element.
    writer.put(std::uint32_t{0});
    writer.put(robot.xy_m2);
    writer.put(robot.yaw_rad2);
  }
}

void encode_shadow(CdrWriter& writer, SimTime time, std::uint64_t step,
                   const ShadowRecord& shadow) {
  writer.clear();
  put_time(writer, time);
  writer.put(step);
  writer.put(shadow.robot.value());
  for (const Pose2& pose : {shadow.X_WR, shadow.X_WS}) {
    for (const double number : {pose.x, pose.y, pose.yaw}) writer.put(number);
  }
  writer.put(shadow.m);
  writer.put(shadow.rad);
  writer.put_sequence(std::span<const double>(shadow.readings));
}

void encode_input(CdrWriter& writer, SimTime time, const RunInput& input) {
  writer.clear();
  put_time(writer, time);
  writer.put(input.step);
  writer.put_string(input.kind);
  writer.put_string(input.robot);
  writer.put_string(input.key);
  writer.put_string(input.value);
  writer.put_string(input.by);
}

void encode_chat(CdrWriter& writer, SimTime time, const RunChat& chat) {
  writer.clear();
  put_time(writer, time);
  writer.put(chat.step);
  writer.put(chat.number);
  for (const std::string* const word : {&chat.from, &chat.role, &chat.to, &chat.name, &chat.text}) {
    writer.put_string(*word);
  }
}

void encode_console(CdrWriter& writer, const ConsoleLine& line) {
  writer.clear();
  put_time(writer, line.time);
  // Levels of rcl_interfaces/msg/Log: 10 debug, 20 info, 30 warning, 40 error.
  writer.put(static_cast<std::uint8_t>(10 + 10 * static_cast<int>(line.level)));
  writer.put_string(line.source);
  writer.put_string(line.text);
  writer.put_string("");
  writer.put_string("");
  writer.put(std::uint32_t{0});
}

void encode_hash(CdrWriter& writer, const StepHash& hash) {
  writer.clear();
  put_time(writer, hash.time);
  writer.put(hash.step);
  writer.put(hash.hash);
}

void encode_end(CdrWriter& writer, const RunEnd& end) {
  writer.clear();
  put_time(writer, end.time);
  writer.put(end.steps);
  writer.put(static_cast<std::uint8_t>(end.hash ? 1 : 0));
  writer.put(end.hash.value_or(0));
}

void encode_run(CdrWriter& writer, const RunInfo& info) {
  writer.clear();
  writer.put_string(info.scenario);
  writer.put_string(info.started);
  writer.put(info.seed);
  writer.put(info.step_s);
  writer.put_count(info.versions.size());
  for (const auto& [name, version] : info.versions) {
    writer.put_string(name);
    writer.put_string(version);
  }
  writer.put_count(info.robots.size());
  for (const RecordedRobot& robot : info.robots) {
    writer.put(robot.id.value());
    writer.put_string(robot.name);
    writer.put_string(robot.kind);
    writer.put_string(robot.team);
  }
  writer.put_count(info.sensors.size());
  for (const RecordedSensor& sensor : info.sensors) {
    writer.put(sensor.robot.value());
    writer.put(sensor.sensor.value());
    writer.put_string(sensor.name);
    writer.put(sensor.kind);
    for (const double value :
         {sensor.X_RS.x, sensor.X_RS.y, sensor.X_RS.yaw, sensor.z_m, sensor.period_s,
          sensor.range_min_m, sensor.range_max_m, sensor.cone_rad}) {
      writer.put(value);
    }
    writer.put_sequence(std::span<const double>(sensor.bearings_rad));
  }
}

}  // namespace rave::record
