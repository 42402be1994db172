// SPDX-License-Identifier: Apache-2.0
#include "rave/record/run_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

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
  EXPECT_TRUE(reader_->check().whole());
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

}  // namespace
}  // namespace rave::record
