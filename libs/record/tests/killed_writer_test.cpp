// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <thread>

#include "rave/record/mcap_reader.hpp"
#include "rave/record/mcap_writer.hpp"
#include "temporary_file.hpp"

namespace rave::record {
namespace {

/// A process that writes messages and, when `role` returns, waits to be killed.
template <class Role>
class Victim {
 public:
  explicit Victim(Role role) : pid_(::fork()) {
    if (pid_ != 0) return;
    role();
    while (true) ::pause();
  }
  Victim(const Victim&) = delete;
  Victim& operator=(const Victim&) = delete;
  ~Victim() { kill(); }
  void kill() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    pid_ = 0;
  }

 private:
  pid_t pid_ = 0;
};

/// Messages 0, 1, 2, ... without a gap; how many.
std::uint32_t count_in_order(const std::filesystem::path& path) {
  const auto reader = McapReader::open(path);
  if (!reader) return 0;
  std::uint32_t count = 0;
  MessageCursor cursor = reader->messages();
  while (true) {
    const auto message = cursor.next();
    EXPECT_TRUE(message) << message.error().text();
    if (!message || !*message) return count;
    EXPECT_EQ((*message)->sequence, count);
    ++count;
  }
}

TEST(KilledWriter, LosesNothingThatWasFlushedAndNothingInBetween) {
  const TemporaryFile file;
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  Victim victim([&] {
    auto writer = McapWriter::open(file.path());
    const auto channel = writer->add_channel("/x", "cdr", 0);
    const std::string payload(1000, 'x');
    for (std::uint32_t i = 0;; ++i) {
      static_cast<void>(writer->write(*channel, i, i, i, bytes_of(payload)));
      if (i == 9'999) {
        static_cast<void>(writer->flush());
        static_cast<void>(!::write(ready[1], "x", 1));
      }
    }
  });
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  victim.kill();
  ::close(ready[0]);
  ::close(ready[1]);
  EXPECT_GE(count_in_order(file.path()), 10'000U);
  const auto reader = McapReader::open(file.path());
  ASSERT_TRUE(reader);
  EXPECT_FALSE(reader->whole());
  EXPECT_FALSE(reader->damages().empty());
}

TEST(KilledWriter, TheThreadWritesAnOpenChunkAlsoWhenNobodyCalls) {
  const TemporaryFile file;
  Victim victim([&] {
    McapWriterOptions options;
    options.flush_interval_s = 0.01;
    auto writer = McapWriter::open(file.path(), options);
    const auto channel = writer->add_channel("/x", "cdr", 0);
    for (std::uint32_t i = 0; i < 100; ++i) {
      static_cast<void>(writer->write(*channel, i, i, i, bytes_of("hello")));
    }
    while (true) ::pause();
  });
  // Ends by the test's time limit if the thread does not write.
  while (count_in_order(file.path()) < 100) std::this_thread::yield();
  victim.kill();
  EXPECT_EQ(count_in_order(file.path()), 100U);
}

TEST(KilledWriter, TheUsualIntervalLeavesHalfASecondForTheDisk) {
  EXPECT_LE(McapWriterOptions{}.flush_interval_s, 0.5);
}

}  // namespace
}  // namespace rave::record
