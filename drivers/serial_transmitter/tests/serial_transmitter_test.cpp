// SPDX-License-Identifier: Apache-2.0
// Over pseudo-terminals, with this test in the place of the radio modem.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): of POSIX, not of C++
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>

#include "rave/base_testing/no_threads.hpp"
#include "rave/live_testing/await.hpp"
#include "rave/live_testing/live_transmitter.hpp"

namespace rave::testing {
namespace {

using std::string_literals::operator""s;

/// The far end of a pseudo-terminal; a link in the file system gives its near end a name that a new
/// one can take over.
class Modem {
 public:
  explicit Modem(std::string link) : link_(std::move(link)) { plug_in(); }
  Modem(const Modem&) = delete;
  Modem& operator=(const Modem&) = delete;
  ~Modem() { unplug(); }

  void plug_in() {
    fd_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    ASSERT_GE(fd_, 0);
    ASSERT_EQ(::grantpt(fd_), 0);
    ASSERT_EQ(::unlockpt(fd_), 0);
    char name[128];
    ASSERT_EQ(::ptsname_r(fd_, name, sizeof name), 0);
    termios raw{};
    ASSERT_EQ(::tcgetattr(fd_, &raw), 0);
    ::cfmakeraw(&raw);
    ASSERT_EQ(::tcsetattr(fd_, TCSANOW, &raw), 0);
    std::filesystem::remove(link_);
    std::filesystem::create_symlink(name, link_);
  }
  void unplug() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
    std::filesystem::remove(link_);
  }
  void write(std::string_view bytes) const {
    ASSERT_EQ(::write(fd_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  /// Reads until there are `size` bytes; a minute at most.
  [[nodiscard]] std::string read(std::size_t size) const {
    std::string bytes;
    char room[512];
    pollfd ready{fd_, POLLIN, 0};
    while (bytes.size() < size && ::poll(&ready, 1, 60'000) == 1) {
      const ssize_t got = ::read(fd_, room, std::min(sizeof room, size - bytes.size()));
      if (got <= 0) break;
      bytes.append(room, static_cast<std::size_t>(got));
    }
    return bytes;
  }

 private:
  std::string link_;
  int fd_ = -1;
};

class SerialTransmitter : public ::testing::Test {
 protected:
  SerialTransmitter()
      : folder_(std::filesystem::temp_directory_path() /
                ("rave_serial_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] std::string link(const std::string& name) const {
    return (folder_ / name).string();
  }

  std::filesystem::path folder_;
};

/// What is on the line for a packet of `size` bytes without zeros.
std::size_t frame_size(std::size_t size) { return size + 5; }

TEST_F(SerialTransmitter, WhatOneSendsAnotherHears) {
  Modem left(link("left"));
  Modem right(link("right"));
  LivePort port_a;
  LivePort port_b;
  LiveTransmitter a("serial_transmitter");
  LiveTransmitter b("serial_transmitter");
  ASSERT_EQ(a.configure({{"device", link("left")}}), "");
  ASSERT_EQ(b.configure({{"device", link("right")}}), "");
  ASSERT_EQ(a.open(port_a), "");
  ASSERT_EQ(b.open(port_b), "");
  // Garbage, torn and repeated frames on the way.
  for (const char* text : {"first", "second", "third"}) ASSERT_EQ(a.send(text), "");
  const std::string first = left.read(frame_size(5));
  const std::string second = left.read(frame_size(6));
  const std::string third = left.read(frame_size(5));
  right.write("\x55\xAA noise");
  right.write(first);
  right.write(second.substr(0, 6));
  right.write(third);
  right.write(third);
  ASSERT_TRUE(port_b.wait_packets(3));
  EXPECT_EQ(port_b.packets(), (std::vector<std::string>{"first", "third", "third"}));
  // Counted when the line has taken it, which may be after it arrived.
  EXPECT_TRUE(await([&] { return a.report()["sent"] == 3; })) << a.report();
  EXPECT_EQ(a.report()["sent_bytes"], first.size() + second.size() + third.size());
}

TEST_F(SerialTransmitter, KeepsToItsRateAndItsQueueIsBounded) {
  Modem modem(link("modem"));
  LivePort port;
  LiveTransmitter a("serial_transmitter");
  // 100 bytes of frame take a second; the queue holds 4 more or less.
  ASSERT_EQ(a.configure({{"device", link("modem")},
                         {"byte_rate", 100.0},
                         {"queue_bytes", 420.0},
                         {"max_packet_bytes", 100.0}}),
            "");
  ASSERT_EQ(a.open(port), "");
  const std::string packet(95, 'x');
  int taken = 0;
  std::string refused;
  for (int i = 0; i < 10; ++i) {
    const std::string error = a.send(packet);
    if (error.empty()) {
      ++taken;
    } else {
      refused = error;
    }
  }
  EXPECT_EQ(refused, "the queue of the line " + link("modem") + " is full");
  // The first is on the line as soon as the thread runs: before any of the others, or after some of
  // them were refused.
  EXPECT_GE(taken, 4);
  EXPECT_LE(taken, 5);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(modem.read(300).size(), 300U);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  // A lower bound, which no load can break: two of the three had to wait.
  EXPECT_GT(took.count(), 1.9);
  EXPECT_EQ(a.report()["queue_full"], 10 - taken);
}

TEST_F(SerialTransmitter, UnpluggedAndPluggedInAgain) {
  Modem modem(link("modem"));
  LivePort port;
  LiveTransmitter a("serial_transmitter");
  ASSERT_EQ(a.configure({{"device", link("modem")}}), "");
  ASSERT_EQ(a.open(port), "");
  for (int round = 1; round <= 2; ++round) {
    modem.unplug();
    ASSERT_TRUE(port.wait_failures(round));
    EXPECT_FALSE(port.failure().empty());
    EXPECT_EQ(a.send("lost"), "the line " + link("modem") + " is lost");
    modem.plug_in();
    ASSERT_TRUE(port.wait_recoveries(round));
    ASSERT_EQ(a.send("back"), "");
    EXPECT_EQ(modem.read(frame_size(4)).substr(2, 4), "back");
  }
  EXPECT_EQ(a.report()["losses"], 2);
}

TEST_F(SerialTransmitter, WithoutAThreadIsAnErrorAndOpensLater) {
  const Modem modem(link("modem"));
  LivePort port;
  LiveTransmitter radio("serial_transmitter");
  ASSERT_EQ(radio.configure({{"device", link("modem")}}), "");
  {
    const base_testing::NoThreads none;
    EXPECT_EQ(radio.open(port).find("cannot start the thread of the line: "), 0U);
  }
  ASSERT_EQ(radio.open(port), "");
  EXPECT_EQ(radio.send("hello"), "");
  EXPECT_EQ(modem.read(frame_size(5)).size(), frame_size(5));
}

TEST_F(SerialTransmitter, SaysWhatIsWrong) {
  LivePort port;
  LiveTransmitter a("serial_transmitter");
  ASSERT_EQ(a.configure({{"device", link("none")}}), "");
  EXPECT_NE(a.open(port), "");
  LiveTransmitter b("serial_transmitter");
  EXPECT_EQ(b.configure({{"device", "x"s}, {"queue_bytes", 64.0}}),
            "`queue_bytes` (64) has no room for the longest packet in its frame (519)");
  LiveTransmitter c("serial_transmitter");
  EXPECT_NE(c.configure({}), "");
}

}  // namespace
}  // namespace rave::testing
