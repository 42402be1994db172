// SPDX-License-Identifier: Apache-2.0
#include "rave/record/merge.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "rave/record/moment_cursor.hpp"
#include "rave/record/robot_ranges.hpp"
#include "rave/record/run_reader.hpp"
#include "sample_run.hpp"

namespace rave::record {
namespace {

namespace fs = std::filesystem;

/// A folder of a run of two hosts: `a` runs anna, `b` bert.
class Merged : public ::testing::Test {
 public:
  ~Merged() override { fs::remove_all(folder_); }

 protected:
  Merged() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }

  /// Writes the record of one process; `take` fills in a step.
  template <class Take>
  void write(const fs::path& file, const std::string& host, std::uint64_t steps, Take take) {
    fs::create_directories((folder_ / file).parent_path());
    RunInfo info = sample_info();
    if (host != "a") info.sensors.clear();
    auto recorder = RunRecorder::open(folder_ / file, info);
    ASSERT_TRUE(recorder) << recorder.error().text();
    const std::string key = host.empty() ? "world" : "name";
    ASSERT_TRUE(recorder->describe(kHostMetadata, {{key, host}}));
    ASSERT_TRUE(recorder->describe(kHostsMetadata, {{"a", "0"}, {"b", "1"}}));
    for (std::uint64_t step = 0; step < steps; ++step) {
      recorder->begin_step(step, SimTime{static_cast<std::int64_t>(step) * 10'000'000});
      take(*recorder, step);
      ASSERT_TRUE(recorder->end_step());
    }
    ASSERT_TRUE(recorder->end(100 + steps));
  }
  void write_host(const std::string& host, std::uint64_t steps, double x_m) {
    const std::uint32_t own = host == "a" ? 0 : 1;
    write(fs::path("hosts") / host / "run.mcap", host, steps,
          [&](RunRecorder& recorder, std::uint64_t step) {
            for (const std::uint32_t robot : {0U, 1U}) {
              const Pose2 X{robot == own ? x_m : -1, 0, 0};
              recorder.pose({RobotId(robot), X, X, {}});
            }
            recorder.command({RobotId(own), DeviceId(0), command_});
            recorder.console(LogLevel::kInfo, "run", "hello");
            if (own == 0) recorder.console(LogLevel::kInfo, "run", "again");
            static_cast<void>(recorder.hash(step + own));
          });
  }
  void write_world(std::uint64_t steps) {
    write("world.mcap", "", steps, [](RunRecorder& recorder, std::uint64_t step) {
      if (step == 1) static_cast<void>(recorder.event({RobotId(1), "contact", "with anna", {}}));
      static_cast<void>(recorder.hash(step * 1000));
    });
  }
  [[nodiscard]] OpenedRun open() {
    const auto run = open_run(folder_);
    EXPECT_TRUE(run) << run.error().text();
    return run ? *run : OpenedRun{};
  }

  fs::path folder_ = fs::temp_directory_path() /
                     fmt::format("rave-{}-{}", ::getpid(),
                                 ::testing::UnitTest::GetInstance()->current_test_info()->name());
  std::vector<std::byte> command_ = std::vector<std::byte>(40);
};

TEST_F(Merged, EachStreamIsThereOnceAndPosesAreThoseOfTheHostThatRunsTheRobot) {
  write_host("a", 3, 5);
  write_host("b", 3, 7);
  write_world(3);
  const OpenedRun run = open();
  EXPECT_TRUE(run.notes.empty()) << run.notes.front();
  const auto reader = McapReader::open(run.file);
  ASSERT_TRUE(reader);
  const auto info = read_run_info(*reader);
  ASSERT_TRUE(info);
  EXPECT_EQ(info->sensors.size(), 1U);
  const auto end = read_run_end(*reader);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->steps, 3U);
  EXPECT_EQ(end->hash, 3U * 103U);
  MomentCursor cursor(
      *reader, {topic::kPoses, topic::kCommands, topic::kHash, topic::kEvents, topic::kConsole});
  for (std::uint64_t step = 0; step < 3; ++step) {
    ASSERT_TRUE(cursor.next().value_or(false));
    const auto poses = decode_poses(cursor.messages(topic::kPoses).at(0));
    ASSERT_TRUE(poses);
    ASSERT_EQ(poses->items.size(), 2U);
    EXPECT_EQ(poses->step, step);
    EXPECT_EQ(poses->items[0].true_pose->x, 5);
    EXPECT_EQ(poses->items[1].true_pose->x, 7);
    const auto commands = decode_commands(cursor.messages(topic::kCommands).at(0));
    EXPECT_EQ(commands->items.size(), 2U);
    EXPECT_EQ(decode_hash(cursor.messages(topic::kHash).at(0))->hash, step * 1002 + 1);
    EXPECT_EQ(cursor.messages(topic::kConsole).size(), 2U) << "what both say is there once";
    EXPECT_EQ(cursor.messages(topic::kEvents).size(), step == 1 ? 1U : 0U);
  }
}

TEST_F(Merged, AnObstacleThatHostsHadAtDifferentStepsCameOnce) {
  const auto say = [](RunRecorder& recorder, const std::string& kind, double revision) {
    ASSERT_TRUE(recorder.event({RobotId(), "obstacle " + kind, "`crate`", {3, revision}}));
  };
  write("hosts/a/run.mcap", "a", 6, [&](RunRecorder& recorder, std::uint64_t step) {
    if (step == 1) say(recorder, "added", 1);
    if (step == 2) say(recorder, "moved", 2);
    if (step == 3) say(recorder, "moved", 3);
    if (step == 5) say(recorder, "removed", 4);
  });
  // The second one came late, and when the obstacle was where it is since change 3.
  write("hosts/b/run.mcap", "b", 6, [&](RunRecorder& recorder, std::uint64_t step) {
    if (step == 4) say(recorder, "added", 3);
    if (step == 4) say(recorder, "removed", 4);
  });
  const auto reader = McapReader::open(open().file);
  ASSERT_TRUE(reader);
  std::vector<std::string> events;
  ASSERT_TRUE(for_each_message(*reader, topic::kEvents, [&](const MessageView& message) -> Status {
    const auto step = decode_event(message.bytes);
    EXPECT_TRUE(step);
    for (const RunEvent& event : step->items) {
      events.push_back(fmt::format("{} {} {}", step->step, event.kind, event.values.at(1)));
    }
    return {};
  }));
  EXPECT_EQ(events, (std::vector<std::string>{"1 obstacle added 1", "2 obstacle moved 2",
                                              "3 obstacle moved 3", "4 obstacle removed 4"}));
}

TEST_F(Merged, ALineOfTheChatThatSeveralHostsHaveIsThereOnce) {
  for (const std::string host : {"a", "b"}) {
    write(fs::path("hosts") / host / "run.mcap", host, 4,
          [&](RunRecorder& recorder, std::uint64_t step) {
            static_cast<void>(recorder.hash(step));
            // Each comes to it in its own step; what is said twice is said twice.
            if (step != (host == "a" ? 1U : 2U)) return;
            static_cast<void>(recorder.chat({step, 1, "ada", "commander", "all", "", "hello"}));
            static_cast<void>(recorder.chat({step, 2, "ada", "commander", "all", "", "hello"}));
          });
  }
  write_world(4);
  const auto reader = McapReader::open(open().file);
  ASSERT_TRUE(reader);
  std::vector<std::uint64_t> numbers;
  ASSERT_TRUE(for_each_message(*reader, topic::kChat, [&](const MessageView& message) -> Status {
    numbers.push_back(decode_chat(message.bytes).value().second.number);
    return {};
  }));
  EXPECT_EQ(numbers, (std::vector<std::uint64_t>{1, 2}));
}

TEST_F(Merged, IsMadeAgainOnlyIfAPartHasChanged) {
  write_host("a", 2, 5);
  write_host("b", 2, 7);
  write_world(2);
  const OpenedRun run = open();
  const auto before = fs::last_write_time(run.file);
  EXPECT_EQ(fs::last_write_time(open().file), before);
  write_host("b", 5, 7);
  write_host("a", 5, 7);
  write_world(5);
  const auto reader = McapReader::open(open().file);
  ASSERT_TRUE(reader);
  EXPECT_EQ(read_run_end(*reader)->steps, 5U);
}

TEST_F(Merged, WhatIsMissingOrTornIsNamed) {
  write_host("a", 200, 5);
  write_world(200);
  EXPECT_EQ(open().notes, std::vector<std::string>{"there is no recording of host `b`"});
  write_host("b", 200, 7);
  EXPECT_TRUE(open().notes.empty());
  const fs::path torn = folder_ / "hosts/b/run.mcap";
  fs::resize_file(torn, fs::file_size(torn) / 2);
  OpenedRun run = open();
  ASSERT_EQ(run.notes.size(), 1U);
  EXPECT_NE(run.notes[0].find("hosts/b/run.mcap` is incomplete"), std::string::npos)
      << run.notes[0];
  std::ofstream(torn) << "nothing";
  run = open();
  ASSERT_EQ(run.notes.size(), 2U);
  EXPECT_NE(run.notes[0].find("is not an MCAP file"), std::string::npos) << run.notes[0];
  const auto reader = McapReader::open(run.file);
  ASSERT_TRUE(reader);
  EXPECT_FALSE(read_run_end(*reader));
  EXPECT_EQ(missing_parts(*reader), run.notes);
}

TEST_F(Merged, ARecordThatWasNotEndedIsTornThoughItIsReadable) {
  write_host("a", 2, 5);
  write_world(2);
  fs::create_directories(folder_ / "hosts/b");
  {
    RunInfo info = sample_info();
    info.sensors.clear();
    auto recorder = RunRecorder::open(folder_ / "hosts/b/run.mcap", info);
    ASSERT_TRUE(recorder);
    ASSERT_TRUE(recorder->describe(kHostMetadata, {{"name", "b"}}));
    record_sample(*recorder, 2);
  }
  const OpenedRun run = open();
  ASSERT_EQ(run.notes.size(), 1U);
  EXPECT_NE(run.notes[0].find("hosts/b/run.mcap` is incomplete: its end is missing"),
            std::string::npos)
      << run.notes[0];
  const auto reader = McapReader::open(run.file);
  ASSERT_TRUE(reader);
  EXPECT_FALSE(read_run_end(*reader)) << "nobody shall take it for whole";
}

TEST_F(Merged, WithoutTheHashOfOneHostInOneStepThereIsNoneFromThenOn) {
  write_host("a", 4, 5);
  write_world(4);
  write("hosts/b/run.mcap", "b", 4, [](RunRecorder& recorder, std::uint64_t step) {
    if (step != 2) static_cast<void>(recorder.hash(step));
  });
  const auto reader = McapReader::open(open().file);
  ASSERT_TRUE(reader);
  std::vector<std::uint64_t> steps;
  ASSERT_TRUE(for_each_message(*reader, topic::kHash, [&](const MessageView& message) -> Status {
    steps.push_back(decode_hash(message.bytes)->step);
    return {};
  }));
  EXPECT_EQ(steps, (std::vector<std::uint64_t>{0, 1}));
  const auto end = read_run_end(*reader);
  ASSERT_TRUE(end);
  EXPECT_FALSE(end->hash);
}

TEST_F(Merged, RecordsOfDifferentRunsAreRefused) {
  write_host("a", 2, 5);
  RunInfo info = sample_info();
  info.seed = 3;
  fs::create_directories(folder_ / "hosts/b");
  auto other = RunRecorder::open(folder_ / "hosts/b/run.mcap", info);
  ASSERT_TRUE(other);
  ASSERT_TRUE(other->end(1));
  const auto run = open_run(folder_);
  ASSERT_FALSE(run);
  EXPECT_NE(run.error().message.find("are recordings of different runs"), std::string::npos);
}

TEST(RobotRanges, ThereAndBack) {
  EXPECT_EQ(robot_ranges({}), "");
  EXPECT_EQ(robot_ranges({4, 1, 2, 0}), "0-2,4");
  EXPECT_EQ(parse_robot_ranges("0-2,4", 5), (std::vector<std::uint32_t>{0, 1, 2, 4}));
  EXPECT_EQ(parse_robot_ranges("", 5), std::vector<std::uint32_t>{});
  for (const char* const bad : {"5", "a", "2-1", "1,1", "-", "1-", "0-4294967296", "3,2"}) {
    EXPECT_FALSE(parse_robot_ranges(bad, 5)) << bad;
  }
}

}  // namespace
}  // namespace rave::record
