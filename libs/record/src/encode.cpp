// SPDX-License-Identifier: Apache-2.0
// From values to CDR, in the layouts that ros_schemas.cpp describes. A change of a layout with
// packed arrays needs another kLayoutVersion.
#include "encode.hpp"

#include "cdr_time.hpp"
#include "packed.hpp"
#include "run_members.hpp"

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
  CdrPut<RunMembers>{writer}(step, event);
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
  CdrPut<RunMembers>{writer}(step, shadow);
}

void encode_input(CdrWriter& writer, SimTime time, const RunInput& input) {
  writer.clear();
  put_time(writer, time);
  CdrPut<RunMembers>{writer}(input);
}

void encode_chat(CdrWriter& writer, SimTime time, const RunChat& chat) {
  writer.clear();
  put_time(writer, time);
  CdrPut<RunMembers>{writer}(chat);
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
  CdrPut<RunMembers>{writer}(info);
}

}  // namespace rave::record
