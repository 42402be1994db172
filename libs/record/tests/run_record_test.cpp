// SPDX-License-Identifier: Apache-2.0
#include "rave/record/run_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <thread>

#include "encode.hpp"
#include "packed.hpp"
#include "rave/record/mcap_reader.hpp"
#include "rave/record/record_summary.hpp"
#include "rave/record/run_reader.hpp"
#include "rave/robot/command.hpp"
#include "rave/robot/reading.hpp"
#include "same_bits.hpp"
#include "sample_run.hpp"
#include "standard_views.hpp"
#include "temporary_file.hpp"

namespace rave::record {
namespace {

static_assert(kRangesKind == static_cast<std::uint32_t>(ReadingKind::kRanges));
static_assert(kVelocityKind == static_cast<std::uint32_t>(CommandKind::kVelocity));
static_assert(sizeof(ReadingHeader) == sizeof(SampleHeader));

constexpr std::uint64_t kSteps = 50;

class RunRecord : public ::testing::Test {
 protected:
  void SetUp() override {
    auto recorder = RunRecorder::open(file_.path(), sample_info());
    ASSERT_TRUE(recorder) << recorder.error().text();
    record_sample(*recorder, kSteps);
    const Status ended = recorder->end(0x0123456789abcdefULL);
    ASSERT_TRUE(ended) << ended.error().text();
    auto reader = McapReader::open(file_.path());
    ASSERT_TRUE(reader) << reader.error().text();
    reader_ = std::make_unique<McapReader>(*std::move(reader));
  }

  /// Calls `check(message)` for all messages of a topic; how many there were.
  template <class Check>
  std::uint64_t each(const char* topic, Check check) {
    const ChannelInfo* channel = reader_->channel(topic);
    EXPECT_NE(channel, nullptr) << topic;
    if (channel == nullptr) return 0;
    MessageCursor cursor = reader_->messages({{channel->id}});
    for (std::uint64_t count = 0;; ++count) {
      const auto message = cursor.next();
      EXPECT_TRUE(message);
      if (!message || !*message) return count;
      check(**message, count);
    }
  }

  TemporaryFile file_;
  std::unique_ptr<McapReader> reader_;
};

/// Both none, or both with the same bits.
void expect_same_bits(const std::optional<Pose2>& a, const std::optional<Pose2>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (a) {
    EXPECT_TRUE(same_bits(&*a, &*b, sizeof(Pose2)));
  }
}

TEST_F(RunRecord, PosesComeBackBitForBit) {
  const auto count = each(topic::kPoses, [](const MessageView& message, std::uint64_t step) {
    const auto read = decode_poses(message.bytes);
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->step, step);
    EXPECT_EQ(read->time.ns, static_cast<std::int64_t>(message.log_time_ns));
    const SampleStep sample = sample_step(step);
    ASSERT_EQ(read->items.size(), sample.poses.size());
    for (std::size_t i = 0; i < sample.poses.size(); ++i) {
      EXPECT_EQ(read->items[i].robot, sample.poses[i].robot);
      expect_same_bits(read->items[i].true_pose, sample.poses[i].true_pose);
      expect_same_bits(read->items[i].reported_pose, sample.poses[i].reported_pose);
      EXPECT_TRUE(same_bits(&read->items[i].velocity_W, &sample.poses[i].velocity_W, 24));
    }
  });
  EXPECT_EQ(count, kSteps);
}

TEST_F(RunRecord, PerceptsComeBackWithTheirParts) {
  const auto count = each(topic::kPercepts, [](const MessageView& message, std::uint64_t step) {
    const auto read = decode_percepts(message.bytes);
    ASSERT_TRUE(read) << read.error().text();
    ASSERT_EQ(read->items.size(), 2U);
    const SampleStep sample = sample_step(step);
    const Percept& real = read->items[0];
    EXPECT_EQ(real.part, PerceptPart::kReal);
    EXPECT_EQ(real.records.size(), 8U);
    const Percept& result = read->items[1];
    EXPECT_EQ(result.part, PerceptPart::kResult);
    EXPECT_EQ(result.robot, RobotId(0));
    EXPECT_EQ(result.sensor, DeviceId(2));
    EXPECT_EQ(result.header,
              (ReadingHeader{read->time.ns - 1, static_cast<std::uint32_t>(step) + 1, 3, 1, 0}));
    ASSERT_EQ(result.records.size(), 12U);
    EXPECT_TRUE(same_bits(result.records.data(), sample.ranges.data(), 12));
  });
  EXPECT_EQ(count, kSteps);
}

TEST_F(RunRecord, ActuatorCommandsAndHashesComeBack) {
  EXPECT_EQ(each(topic::kActuators,
                 [](const MessageView& message, std::uint64_t step) {
                   const auto read = decode_actuators(message.bytes);
                   ASSERT_TRUE(read && read->items.size() == 1);
                   EXPECT_EQ(read->items[0].robot, RobotId(1));
                   EXPECT_EQ(text_of(read->items[0].command), text_of(sample_step(step).command));
                 }),
            kSteps);
  EXPECT_EQ(each(topic::kHash,
                 [](const MessageView& message, std::uint64_t step) {
                   const auto read = decode_hash(message.bytes);
                   ASSERT_TRUE(read);
                   EXPECT_EQ(read->step, step);
                   EXPECT_EQ(read->hash, step * 0x9e3779b97f4a7c15ULL);
                 }),
            kSteps);
}

TEST(RunRecordInputs, ComeBackInTheirOrder) {
  const TemporaryFile file;
  const RunInput inputs[] = {{0, "set", "anna", "program.cruise_mps", "0.1"},
                             {0, "stop", "", "", ""},
                             {1, "release", "bert", "", ""}};
  auto recorder = RunRecorder::open(file.path(), sample_info());
  ASSERT_TRUE(recorder);
  ASSERT_TRUE(recorder->input(inputs[0]));
  ASSERT_TRUE(recorder->input(inputs[1]));
  record_sample(*recorder, 1);
  ASSERT_TRUE(recorder->input(inputs[2]));
  ASSERT_TRUE(recorder->end(1));
  const auto reader = McapReader::open(file.path());
  ASSERT_TRUE(reader);
  std::vector<RunInput> read;
  ASSERT_TRUE(for_each_message(*reader, topic::kInputs, [&](const MessageView& message) -> Status {
    read.push_back(decode_input(message.bytes).value());
    return {};
  }));
  EXPECT_TRUE(std::ranges::equal(read, inputs));
  EXPECT_FALSE(decode_input({}));
}

TEST(RunRecordChat, ComesBackWithAuthorAndAddressee) {
  const TemporaryFile file;
  auto recorder = RunRecorder::open(file.path(), sample_info());
  ASSERT_TRUE(recorder);
  record_sample(*recorder, 1);
  ASSERT_TRUE(recorder->chat({2, 7, "ada", "commander", "robot", "anna", "gr\u00fc\u00dfe"}));
  ASSERT_TRUE(recorder->end(1));
  const auto reader = McapReader::open(file.path());
  ASSERT_TRUE(reader);
  std::vector<std::pair<SimTime, RunChat>> read;
  ASSERT_TRUE(for_each_message(*reader, topic::kChat, [&](const MessageView& message) -> Status {
    EXPECT_FALSE(decode_chat(message.bytes.first(message.bytes.size() - 1)));
    read.push_back(decode_chat(message.bytes).value());
    return {};
  }));
  ASSERT_EQ(read.size(), 1U);
  const RunChat& chat = read[0].second;
  EXPECT_EQ(chat.step, 2U);
  EXPECT_EQ(chat.number, 7U);
  EXPECT_EQ(chat.from + chat.role + chat.to + chat.name, "adacommanderrobotanna");
  EXPECT_EQ(chat.text, "gr\u00fc\u00dfe");
  EXPECT_FALSE(decode_chat({}));
}

TEST_F(RunRecord, OneSensorAndOneRobotAreReadAtATime) {
  const auto run = read_run_info(*reader_);
  ASSERT_TRUE(run) << run.error().text();
  EXPECT_EQ(run->inputs, sample_info().inputs);
  EXPECT_EQ(run->expanded_scenario, sample_info().expanded_scenario);
  const auto robot = find_robot(*run, "anna");
  ASSERT_TRUE(robot);
  const auto sensor = find_sensor(*run, **robot, "laser");
  ASSERT_TRUE(sensor);
  EXPECT_NE(find_robot(*run, "ana").error().text().find("did you mean `anna`?"), std::string::npos);
  EXPECT_FALSE(find_sensor(*run, run->robots[1], "laser"));
  const auto all = read_samples(*reader_, (*robot)->id, (*sensor)->sensor, PerceptPart::kResult);
  ASSERT_TRUE(all);
  ASSERT_EQ(all->samples.size(), kSteps);
  for (std::size_t step = 0; step < kSteps; ++step) {
    const auto bytes = all->records_of(all->samples[step]);
    ASSERT_EQ(bytes.size(), 12U);
    EXPECT_TRUE(same_bits(bytes.data(), sample_step(step).ranges.data(), 12));
    EXPECT_EQ(all->samples[step].delivered.ns, all->samples[step].header.stamp_ns + 1);
  }
  const auto halves = read_samples(*reader_, (*robot)->id, (*sensor)->sensor, PerceptPart::kReal);
  ASSERT_TRUE(halves);
  EXPECT_EQ(halves->records.size(), kSteps * 8);
  const auto track = read_poses(*reader_, RobotId(1));
  ASSERT_TRUE(track && track->size() == kSteps);
  EXPECT_FALSE((*track)[0].reported_pose);
  EXPECT_EQ((*track)[7].reported_pose, sample_step(7).poses[1].reported_pose);
  EXPECT_TRUE(read_run_end(*reader_)->hash.has_value());
}

TEST_F(RunRecord, CommandsRadioEventsAndConsoleComeBack) {
  EXPECT_EQ(each(topic::kCommands,
                 [](const MessageView& message, std::uint64_t step) {
                   const auto read = decode_commands(message.bytes);
                   ASSERT_TRUE(read && read->items.size() == 1);
                   EXPECT_EQ(read->items[0].robot, RobotId(1));
                   EXPECT_EQ(text_of(read->items[0].command), text_of(sample_step(step).command));
                 }),
            kSteps);
  EXPECT_EQ(each(topic::kRadio,
                 [](const MessageView& message, std::uint64_t index) {
                   const auto read = decode_radio(message.bytes);
                   ASSERT_TRUE(read && read->items.size() == 1);
                   const RadioPacket& packet = read->items[0];
                   EXPECT_EQ(packet.transmitter, 4);
                   EXPECT_EQ(packet.delivered, index != 0);
                   EXPECT_EQ(packet.sent_ns, read->time.ns - 5);
                   std::uint64_t payload = 0;
                   ASSERT_EQ(packet.payload.size(), sizeof payload);
                   std::memcpy(&payload, packet.payload.data(), sizeof payload);
                   EXPECT_EQ(payload, 3 * index);
                 }),
            17U);
  EXPECT_EQ(each(topic::kEvents,
                 [](const MessageView& message, std::uint64_t index) {
                   const auto read = decode_event(message.bytes);
                   ASSERT_TRUE(read && read->items.size() == 1);
                   EXPECT_EQ(read->step, 4 * index);
                   EXPECT_EQ(read->items[0].kind, "contact");
                   EXPECT_EQ(read->items[0].text, "bert touches a wall");
                   ASSERT_EQ(read->items[0].values.size(), 2U);
                   EXPECT_TRUE(std::signbit(read->items[0].values[1]));
                 }),
            13U);
  EXPECT_EQ(each(topic::kConsole,
                 [](const MessageView& message, std::uint64_t index) {
                   const auto read = decode_console(message.bytes);
                   ASSERT_TRUE(read);
                   EXPECT_EQ(read->time.ns, static_cast<std::int64_t>(index) * 50'000'000);
                   EXPECT_EQ(read->level, LogLevel::kWarning);
                   EXPECT_EQ(read->source, "robot anna");
                   EXPECT_EQ(read->text, "low battery");
                 }),
            10U);
}

TEST_F(RunRecord, SummaryTellsTheRun) {
  const auto summary = describe_record(file_.path());
  ASSERT_TRUE(summary) << summary.error().text();
  EXPECT_TRUE(summary->ended);
  EXPECT_FALSE(summary->checked);
  ASSERT_TRUE(summary->run);
  const RunInfo info = sample_info();
  EXPECT_EQ(summary->run->scenario, info.scenario);
  EXPECT_EQ(summary->run->seed, info.seed);
  EXPECT_EQ(summary->run->step_s, info.step_s);
  EXPECT_EQ(summary->run->versions, info.versions);
  EXPECT_EQ(summary->run->robots, info.robots);
  EXPECT_EQ(summary->run->sensors, info.sensors);
  EXPECT_EQ(summary->run->expanded_scenario, info.expanded_scenario);
  ASSERT_TRUE(summary->end);
  EXPECT_EQ(summary->end->steps, kSteps);
  EXPECT_EQ(summary->end->hash, 0x0123456789abcdefULL);
  EXPECT_DOUBLE_EQ(summary->end_s, 0.49);
  const auto poses = std::ranges::find(summary->channels, "/rave/poses", &ChannelSummary::topic);
  ASSERT_NE(poses, summary->channels.end());
  EXPECT_EQ(poses->messages, kSteps);
  EXPECT_EQ(poses->schema, "rave_msgs/msg/Poses");
  EXPECT_NEAR(poses->rate_hz, 50 / 0.49, 1e-9);
  EXPECT_TRUE(reader_->verify());
}

TEST_F(RunRecord, ViewsAreStandardMessagesAtTheirRate) {
  EXPECT_EQ(each("/tf", [](const MessageView&, std::uint64_t) {}), 5U);
  EXPECT_EQ(each("/tf_static", [](const MessageView&, std::uint64_t) {}), 1U);
  EXPECT_EQ(each("/bert/cmd_vel", [](const MessageView&, std::uint64_t) {}), 5U);
  const auto scans = each("/anna/laser", [](const MessageView& message, std::uint64_t index) {
    CdrReader reader(message.bytes);
    static_cast<void>(reader.get<std::int32_t>());
    static_cast<void>(reader.get<std::uint32_t>());
    EXPECT_EQ(reader.get_string(), "anna/laser");
    EXPECT_EQ(reader.get<float>(), -0.5F);
    EXPECT_EQ(reader.get<float>(), 0.5F);
    EXPECT_EQ(reader.get<float>(), 0.5F);
    for (int i = 0; i < 4; ++i) static_cast<void>(reader.get<float>());
    EXPECT_EQ(reader.get_sequence<float>(), sample_step(10 * index).ranges);
    EXPECT_TRUE(reader.ok());
  });
  EXPECT_EQ(scans, 5U);
}

TEST(RunRecordThreads, ConsoleMayBeCalledFromAnywhere) {
  const TemporaryFile file;
  {
    auto recorder = RunRecorder::open(file.path(), sample_info());
    ASSERT_TRUE(recorder);
    std::thread other([&] {
      for (int i = 0; i < 1000; ++i) recorder->console(LogLevel::kInfo, "other", "line");
    });
    record_sample(*recorder, 100);
    other.join();
    ASSERT_TRUE(recorder->end(std::nullopt));
  }
  const auto summary = describe_record(file.path());
  ASSERT_TRUE(summary && summary->end);
  EXPECT_FALSE(summary->end->hash);
  const auto console = std::ranges::find(summary->channels, "/rosout", &ChannelSummary::topic);
  ASSERT_NE(console, summary->channels.end());
  EXPECT_EQ(console->messages, 1020U);
}

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
    if (channel->topic == topic::kPercepts) {
      const auto read = decode_percepts((*message)->bytes);
      ASSERT_TRUE(read && read->items.size() == 4) << read.error().text();
      for (std::uint32_t r = 0; r < 4; ++r) {
        const Percept& percept = read->items[r];
        EXPECT_EQ(percept.robot, RobotId(r));
        EXPECT_EQ(percept.header,
                  (ReadingHeader{7, static_cast<std::uint32_t>(read->step), 2, 1, 0}));
        ASSERT_EQ(percept.records.size(), 8U);
        EXPECT_TRUE(same_bits(percept.records.data(), &ranges[2 * r], 8));
      }
    } else if (channel->topic == topic::kCommands) {
      const auto read = decode_commands((*message)->bytes);
      ASSERT_TRUE(read && read->items.size() == 4);
      for (const CommandRecord& command : read->items) {
        ASSERT_EQ(command.command.size(), 40U);
        EXPECT_EQ(std::memcmp(command.command.data(), &commands[40 * command.robot.value()], 40),
                  0);
      }
    } else if (channel->topic == topic::kPoses) {
      const auto read = decode_poses((*message)->bytes);
      ASSERT_TRUE(read);
      EXPECT_EQ(read->items, poses);
    }
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
  writer.put_packed(std::span<const PackedPercept>(&element, 1));
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
