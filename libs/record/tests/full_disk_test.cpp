// SPDX-License-Identifier: Apache-2.0
// What is left of a record when the disk is full, and who is told.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "rave/base/random.hpp"
#include "rave/base_testing/no_threads.hpp"
#include "rave/record/mcap_reader.hpp"
#include "rave/record/mcap_writer.hpp"
#include "rave/record/run_reader.hpp"
#include "rave/record/run_record.hpp"
#include "sample_run.hpp"
#include "temporary_file.hpp"

namespace rave::record {
namespace {

McapWriterOptions tiny_chunks() {
  McapWriterOptions options;
  options.chunk_bytes = 256;
  options.flush_interval_s = 1000;
  return options;
}

/// As long as it is there, the file has room for so many bytes more.
class FullDisk {
 public:
  FullDisk(const TemporaryFile& file, std::uint64_t room) {
    std::signal(SIGXFSZ, SIG_IGN);
    EXPECT_EQ(::getrlimit(RLIMIT_FSIZE, &before_), 0);
    const rlimit full{std::filesystem::file_size(file.path()) + room, before_.rlim_max};
    EXPECT_EQ(::setrlimit(RLIMIT_FSIZE, &full), 0);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk() { EXPECT_EQ(::setrlimit(RLIMIT_FSIZE, &before_), 0); }

 private:
  rlimit before_{};
};

TEST(McapWriterStart, WithoutAThreadIsAnErrorAndOpensLater) {
  const TemporaryFile file;
  {
    const base_testing::NoThreads none;
    const auto writer = McapWriter::open(file.path(), tiny_chunks());
    ASSERT_FALSE(writer);
    EXPECT_NE(writer.error().message.find("cannot start the thread of the recording"),
              std::string::npos)
        << writer.error().text();
  }
  auto writer = McapWriter::open(file.path(), tiny_chunks());
  ASSERT_TRUE(writer) << writer.error().text();
  EXPECT_TRUE(writer->close());
}

TEST(FullDisk, OfALongPieceThatDoesNotFitNothingIsLeft) {
  const TemporaryFile file;
  auto writer = McapWriter::open(file.path(), tiny_chunks());
  ASSERT_TRUE(writer) << writer.error().text();
  const auto channel = writer->add_channel("/x", "cdr", 0);
  for (std::uint32_t i = 0; i < 20; ++i) ASSERT_TRUE(writer->write(*channel, i, i, i, {}));
  ASSERT_TRUE(writer->flush());
  std::vector<std::byte> noise(100'000);
  RandomStream random(1, 2, 3, 4);
  for (std::byte& byte : noise) byte = static_cast<std::byte>(random.bits() & 0xffU);
  {
    // More of it fits than the index takes that comes in its place.
    const FullDisk disk(file, 50'000);
    static_cast<void>(writer->write(*channel, 20, 20, 20, noise));
    EXPECT_FALSE(writer->flush());
    EXPECT_FALSE(writer->close());
  }
  const auto reader = McapReader::open(file.path());
  ASSERT_TRUE(reader) << reader.error().text();
  EXPECT_TRUE(reader->whole());
  EXPECT_TRUE(reader->check().whole());
  EXPECT_EQ(reader->statistics().message_count, 20U);
}

TEST(FullDisk, AStepThatCannotBeWrittenIsAnErrorWhateverItHolds) {
  const TemporaryFile file;
  RunRecorderOptions options;
  options.file = tiny_chunks();
  auto recorder = RunRecorder::open(file.path(), sample_info(), options);
  ASSERT_TRUE(recorder) << recorder.error().text();
  record_sample(*recorder, 3);
  ASSERT_TRUE(recorder->flush());
  {
    const FullDisk disk(file, 10);
    record_sample(*recorder, 3);
    EXPECT_FALSE(recorder->flush());
    const SampleStep sample = sample_step(1);
    const auto step_with = [&](auto fill) {
      recorder->begin_step(9, SimTime{90'000'000});
      fill();
      return recorder->end_step();
    };
    EXPECT_FALSE(step_with([&] { recorder->poses(sample.poses); }));
    EXPECT_FALSE(step_with([&] { recorder->command({RobotId(1), DeviceId(0), sample.command}); }));
    EXPECT_FALSE(step_with([&] { recorder->actuator({RobotId(1), DeviceId(0), sample.command}); }));
    EXPECT_FALSE(step_with([&] { recorder->console(LogLevel::kInfo, "test", "hello"); }));
    EXPECT_TRUE(step_with([] {})) << "nothing was to be written";
  }
  const Status ended = recorder->end(7);
  ASSERT_FALSE(ended);
  EXPECT_NE(ended.error().text().find("File too large"), std::string::npos) << ended.error().text();
  const auto reader = McapReader::open(file.path());
  ASSERT_TRUE(reader) << reader.error().text();
  EXPECT_FALSE(read_run_end(*reader)) << "nobody shall take it for whole";
}

}  // namespace
}  // namespace rave::record
