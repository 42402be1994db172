// SPDX-License-Identifier: Apache-2.0
// What a message of a record holds, byte for byte: rows, channels of their own, and what is
// refused.
#include <gtest/gtest.h>

#include <map>

#include "encode.hpp"
#include "packed.hpp"
#include "rave/record/mcap_reader.hpp"
#include "rave/record/run_reader.hpp"
#include "rave/record/run_record.hpp"
#include "rave/robot/command.hpp"
#include "rave/robot/reading.hpp"
#include "same_bits.hpp"
#include "sample_run.hpp"
#include "temporary_file.hpp"

namespace rave::record {
namespace {

/// Two steps: robots 1 to 3 alike in blocks, robot 0 alone.
void record_blocks(RunRecorder& recorder, std::span<const float> ranges,
                   std::span<const std::byte> commands, std::span<const RobotPose> poses) {
  const auto bytes = std::as_bytes(ranges);
  for (std::uint64_t step = 0; step < 2; ++step) {
    recorder.begin_step(step, SimTime{static_cast<std::int64_t>(step) * 200'000'000});
    const ReadingHeader header{7, static_cast<std::uint32_t>(step), 2, 1, 0};
    recorder.percept({RobotId(0), DeviceId(1), 1, PerceptPart::kResult, header, bytes.first(8)});
    recorder.percepts({RobotId(1), 3, DeviceId(1), 1, header, bytes.subspan(8)});
    recorder.commands({RobotId(1), 3, DeviceId(0), commands.subspan(40)});
    recorder.command({RobotId(0), DeviceId(0), commands.first(40)});
    recorder.pose(poses[0]);
    recorder.poses({RobotId(1), 3, &*poses[1].true_pose, &poses[1].velocity_W, sizeof(RobotPose)});
    ASSERT_TRUE(recorder.end_step());
  }
}

/// What record_blocks() has recorded for four robots.
struct Row {
  const std::vector<float>& ranges;
  const std::vector<std::byte>& commands;
  const std::vector<RobotPose>& poses;
};

/// A message of the record has what was recorded, if it is of percepts, commands or poses.
void expect_row(const std::string& name, std::span<const std::byte> bytes, const Row& row) {
  if (name == topic::kPercepts) {
    const auto read = decode_percepts(bytes);
    ASSERT_TRUE(read && read->items.size() == 4) << read.error().text();
    for (std::uint32_t r = 0; r < 4; ++r) {
      const Percept& percept = read->items[r];
      EXPECT_EQ(percept.robot, RobotId(r));
      EXPECT_EQ(percept.header,
                (ReadingHeader{7, static_cast<std::uint32_t>(read->step), 2, 1, 0}));
      ASSERT_EQ(percept.records.size(), 8U);
      EXPECT_TRUE(same_bits(percept.records.data(), &row.ranges[2 * r], 8));
    }
  } else if (name == topic::kCommands) {
    const auto read = decode_commands(bytes);
    ASSERT_TRUE(read && read->items.size() == 4);
    for (const CommandRecord& command : read->items) {
      ASSERT_EQ(command.command.size(), 40U);
      const std::byte* const given = &row.commands[40 * command.robot.value()];
      EXPECT_EQ(std::memcmp(command.command.data(), given, 40), 0);
    }
  } else if (name == topic::kPoses) {
    const auto read = decode_poses(bytes);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->items, row.poses);
  }
}

TEST(RunRecordBlocks, EachRobotOfARowComesBackBitForBit) {
  const TemporaryFile file;
  RunInfo info = sample_info();
  info.robots = {{RobotId(0), "anna", "simulated", ""}, {RobotId(1), "bert", "simulated", ""}};
  info.sensors[0].robot = RobotId(1);
  info.sensors[0].sensor = DeviceId(1);
  info.sensors[0].bearings_rad = {0, 0.5};
  const std::vector<float> ranges = {0, 1, 2, 3, -0.0F, 5, 6, 7};
  std::vector<std::byte> commands;
  std::vector<RobotPose> poses;
  for (std::uint32_t r = 0; r < 4; ++r) {
    const SampleStep sample = sample_step(r + 1);
    commands.insert(commands.end(), sample.command.begin(), sample.command.end());
    const Pose2 X_WR{0.1 * r, -0.0, 3};
    poses.push_back({RobotId(r), X_WR, X_WR, {1.0 * r, -0.0, 2}});
  }
  auto recorder = RunRecorder::open(file.path(), info);
  ASSERT_TRUE(recorder);
  record_blocks(*recorder, ranges, commands, poses);
  ASSERT_TRUE(recorder->end(1));

  const auto reader = McapReader::open(file.path());
  ASSERT_TRUE(reader);
  std::map<std::string, int> messages;
  MessageCursor cursor = reader->messages();
  for (auto message = cursor.next(); message && *message; message = cursor.next()) {
    const auto channel =
        std::ranges::find(reader->channels(), (*message)->channel, &ChannelInfo::id);
    ++messages[channel->topic];
    expect_row(channel->topic, (*message)->bytes, {ranges, commands, poses});
  }
  EXPECT_EQ(messages[topic::kPercepts], 2);
  EXPECT_EQ(messages[topic::kCommands], 2);
  EXPECT_EQ(messages[topic::kPoses], 2);
  // Robots of a row are seen by viewers as any other.
  EXPECT_EQ(messages["/bert/laser"], 2);
  EXPECT_EQ(messages["/bert/cmd_vel"], 2);
  EXPECT_EQ(messages["/tf"], 2);
}

/// The message of the percepts of one block, with `robots` of its element and `version` replaced.
std::string error_of_percepts(std::uint32_t version, std::uint32_t robots, std::uint32_t size) {
  CdrWriter writer;
  encode_step_head(writer, SimTime{}, 0, 1);
  PackedPercept element{};
  element.size = size;
  element.robots = robots;
  for (const std::byte byte : std::as_bytes(std::span(&element, 1))) {
    writer.put(static_cast<std::uint8_t>(byte));
  }
  writer.put_count(12);
  for (int i = 0; i < 12; ++i) writer.put(std::uint8_t{1});
  std::vector<std::byte> bytes(writer.bytes().begin(), writer.bytes().end());
  std::memcpy(bytes.data() + 4 + 16, &version, sizeof version);
  const auto read = decode_percepts(bytes);
  return read ? fmt::format("{} percepts", read->items.size()) : read.error().text();
}

TEST(RunRecordDecode, RowsWithoutEqualPartsAndOtherLayoutsAreErrors) {
  const std::string malformed =
      "a message of `/rave/percepts` does not have the format that RAVE writes";
  EXPECT_EQ(error_of_percepts(kLayoutVersion, 3, 12), "3 percepts");
  EXPECT_EQ(error_of_percepts(kLayoutVersion, 1, 0), "1 percepts");
  EXPECT_EQ(error_of_percepts(kLayoutVersion, 5, 12), malformed);
  EXPECT_EQ(error_of_percepts(kLayoutVersion, 0, 12), malformed);
  EXPECT_EQ(error_of_percepts(kLayoutVersion, 0xffff'ffffU, 0), malformed);
  EXPECT_EQ(error_of_percepts(kLayoutVersion, 1, 13), malformed);
  EXPECT_EQ(error_of_percepts(1, 3, 12),
            "a message of `/rave/percepts` has layout 1; this RAVE reads layout 2, so another "
            "version of RAVE wrote the recording");
}

TEST(RunRecordShadows, HaveAChannelOfTheirOwn) {
  const TemporaryFile file;
  auto recorder = RunRecorder::open(file.path(), sample_info());
  ASSERT_TRUE(recorder);
  recorder->begin_step(7, SimTime{70'000'000});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(recorder->shadow({RobotId(3), {1, 2, 0.5}, {-0.0, 2.5, -3}, 0.75, 0.125, {nan, 4}}));
  ASSERT_TRUE(recorder->end_step());
  ASSERT_TRUE(recorder->end(std::nullopt));
  const auto reader = McapReader::open(file.path());
  ASSERT_TRUE(reader);
  int count = 0;
  const auto take = [&](const MessageView& message) -> Status {
    RAVE_TRY_ASSIGN(const auto step, decode_shadow(message.bytes));
    EXPECT_EQ(step.step, 7U);
    EXPECT_EQ(step.time.ns, 70'000'000);
    const ShadowRecord& shadow = step.items.at(0);
    EXPECT_EQ(shadow.robot.value(), 3U);
    EXPECT_EQ(shadow.X_WR, (Pose2{1, 2, 0.5}));
    EXPECT_TRUE(std::signbit(shadow.X_WS.x));
    EXPECT_EQ(shadow.X_WS.yaw, -3);
    EXPECT_EQ(shadow.m, 0.75);
    EXPECT_EQ(shadow.rad, 0.125);
    EXPECT_EQ(shadow.readings.size(), 2U);
    EXPECT_TRUE(std::isnan(shadow.readings[0]));
    ++count;
    for (std::size_t size = 0; size < message.bytes.size(); ++size) {
      EXPECT_FALSE(decode_shadow(message.bytes.first(size)));
    }
    return {};
  };
  EXPECT_TRUE(for_each_message(*reader, topic::kShadows, take));
  EXPECT_EQ(count, 1);
}

TEST(RunRecordVariances, HaveAChannelOfTheirOwn) {
  const TemporaryFile file;
  auto recorder = RunRecorder::open(file.path(), sample_info());
  ASSERT_TRUE(recorder);
  const std::vector<PoseVariance> told = {{RobotId(0), 1e-300, -0.0}, {RobotId(1), 0.25, 0.01}};
  recorder->begin_step(7, SimTime{70'000'000});
  ASSERT_TRUE(recorder->variances(told));
  ASSERT_TRUE(recorder->end_step());
  recorder->begin_step(8, SimTime{80'000'000});
  ASSERT_TRUE(recorder->variances({}));
  ASSERT_TRUE(recorder->end_step());
  ASSERT_TRUE(recorder->end(std::nullopt));
  const auto reader = McapReader::open(file.path());
  ASSERT_TRUE(reader);
  std::vector<StepOf<PoseVariance>> read;
  const auto take = [&](const MessageView& message) -> Status {
    RAVE_TRY_ASSIGN(read.emplace_back(), decode_variances(message.bytes));
    for (std::size_t size = 0; size < message.bytes.size(); ++size) {
      EXPECT_FALSE(decode_variances(message.bytes.first(size)));
    }
    return {};
  };
  EXPECT_TRUE(for_each_message(*reader, topic::kVariances, take));
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].step, 7U);
  EXPECT_EQ(read[0].time.ns, 70'000'000);
  EXPECT_EQ(read[0].items, told);
  EXPECT_TRUE(std::signbit(read[0].items.at(0).yaw_rad2));
  EXPECT_TRUE(read[1].items.empty());
}

TEST(RunRecordDecode, ACutMessageIsAnErrorWithItsTopic) {
  const TemporaryFile file;
  auto recorder = RunRecorder::open(file.path(), sample_info());
  ASSERT_TRUE(recorder);
  record_sample(*recorder, 1);
  ASSERT_TRUE(recorder->end(1));
  const auto reader = McapReader::open(file.path());
  ASSERT_TRUE(reader);
  const auto try_all = [](std::span<const std::byte> bytes) {
    const bool results[] = {decode_run(bytes).has_value(),      decode_end(bytes).has_value(),
                            decode_poses(bytes).has_value(),    decode_percepts(bytes).has_value(),
                            decode_commands(bytes).has_value(), decode_radio(bytes).has_value(),
                            decode_event(bytes).has_value(),    decode_console(bytes).has_value(),
                            decode_shadow(bytes).has_value()};
    return std::ranges::count(results, true);
  };
  MessageCursor cursor = reader->messages();
  for (auto message = cursor.next(); message && *message; message = cursor.next()) {
    for (std::size_t size = 0; size < (*message)->bytes.size(); ++size) {
      static_cast<void>(try_all((*message)->bytes.first(size)));
    }
  }
  EXPECT_EQ(try_all({}), 0);
  EXPECT_EQ(decode_poses({}).error().text(),
            "a message of `/rave/poses` does not have the format that RAVE writes");
}

}  // namespace
}  // namespace rave::record
