// SPDX-License-Identifier: Apache-2.0
// Against a pseudo-terminal and a TCP server of the test's own.
#include "rave/line/byte_line.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): of POSIX, not of C++
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <thread>

namespace rave::line {
namespace {

// Far beyond what any test needs: a wait that ends by it has failed.
constexpr Wait kLong{100'000};

/// The device's end of a pseudo-terminal.
class Terminal {
 public:
  Terminal() : fd_(::posix_openpt(O_RDWR | O_NOCTTY)) {
    EXPECT_EQ(::grantpt(fd_), 0);
    EXPECT_EQ(::unlockpt(fd_), 0);
    path_ = ::ptsname(fd_);
  }
  ~Terminal() { close(); }
  void close() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }
  [[nodiscard]] int fd() const { return fd_; }
  [[nodiscard]] Address address() const { return {path_, 115200, "", ""}; }

 private:
  int fd_;
  std::string path_;
};

std::string take(ByteLine& line, std::size_t size) {
  std::string all;
  std::array<char, 64> room{};
  while (all.size() < size) {
    const ReadResult got = line.read(room, kLong, nullptr);
    if (got.end != ReadEnd::kBytes) return all + "<end>";
    all.append(room.data(), got.size);
  }
  return all;
}

TEST(ByteLine, SerialBytesGoThroughUnchanged) {
  Terminal terminal;
  auto line = ByteLine::open(terminal.address(), kLong, nullptr);
  ASSERT_TRUE(line) << line.error().text();
  const std::string bytes("a\r\n\x03\x11\x13\x00\xff", 8);  // a cooked terminal would change them
  ASSERT_EQ(::write(terminal.fd(), bytes.data(), bytes.size()), 8);
  EXPECT_EQ(take(*line, 8), bytes);
  ASSERT_TRUE(line->write(bytes, kLong, nullptr));
  std::array<char, 16> room{};
  std::string back;
  while (back.size() < 8) {
    const auto size = ::read(terminal.fd(), room.data(), room.size());
    ASSERT_GT(size, 0);
    back.append(room.data(), static_cast<std::size_t>(size));
  }
  EXPECT_EQ(back, bytes);
}

TEST(ByteLine, ALineThatGoesIsLost) {
  Terminal terminal;
  auto line = ByteLine::open(terminal.address(), kLong, nullptr);
  ASSERT_TRUE(line);
  terminal.close();
  std::array<char, 16> room{};
  EXPECT_EQ(line->read(room, kLong, nullptr).end, ReadEnd::kLost);
  EXPECT_FALSE(line->lost().empty());
  const Status written = line->write("x", kLong, nullptr);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().text(), "the line is lost: " + line->lost());
}

TEST(ByteLine, TheBellEndsAWait) {
  Terminal terminal;
  Wake wake;
  ASSERT_TRUE(wake.open());
  auto line = ByteLine::open(terminal.address(), kLong, &wake);
  ASSERT_TRUE(line);
  std::thread other([&] { wake.ring(); });
  std::array<char, 16> room{};
  EXPECT_EQ(line->read(room, kLong, &wake).end, ReadEnd::kWoken);
  other.join();
  wake.clear();
  EXPECT_EQ(line->read(room, Wait(1), &wake).end, ReadEnd::kTimeout);
}

TEST(ByteLine, ErrorsNameTheDevice) {
  auto missing = ByteLine::open({"/dev/no-such-laser", 115200, "", ""}, kLong, nullptr);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(missing.error().text(), "cannot open `/dev/no-such-laser`: No such file or directory");
  auto null = ByteLine::open({"/dev/null", 115200, "", ""}, kLong, nullptr);
  ASSERT_FALSE(null);
  EXPECT_EQ(null.error().text(), "`/dev/null` is not a serial line");
}

/// A listening socket on a free port of the loopback.
class Server {
 public:
  Server() : fd_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in own{};
    own.sin_family = AF_INET;
    own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::bind(fd_, reinterpret_cast<sockaddr*>(&own), sizeof own), 0);
    EXPECT_EQ(::listen(fd_, 1), 0);
    socklen_t size = sizeof own;
    EXPECT_EQ(::getsockname(fd_, reinterpret_cast<sockaddr*>(&own), &size), 0);
    port_ = ntohs(own.sin_port);
  }
  ~Server() { close(); }
  void close() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }
  [[nodiscard]] int accept() const { return ::accept(fd_, nullptr, nullptr); }
  [[nodiscard]] Address address() const { return {"", 0, "127.0.0.1", std::to_string(port_)}; }

 private:
  int fd_;
  std::uint16_t port_ = 0;
};

TEST(ByteLine, TcpBytesGoThroughUntilTheServerCloses) {
  Server server;
  auto line = ByteLine::open(server.address(), kLong, nullptr);
  ASSERT_TRUE(line) << line.error().text();
  const int peer = server.accept();
  ASSERT_TRUE(line->write("ping", kLong, nullptr));
  std::array<char, 4> got{};
  ASSERT_EQ(::recv(peer, got.data(), got.size(), MSG_WAITALL), 4);
  EXPECT_EQ(std::string(got.data(), 4), "ping");
  ASSERT_EQ(::send(peer, "pong", 4, 0), 4);
  EXPECT_EQ(take(*line, 4), "pong");
  ::close(peer);
  EXPECT_EQ(line->read(got, kLong, nullptr).end, ReadEnd::kLost);
  EXPECT_EQ(line->lost(), "the other end closed the connection");
}

TEST(ByteLine, ARefusedConnectionIsAnError) {
  Server server;
  const Address address = server.address();
  server.close();
  auto line = ByteLine::open(address, kLong, nullptr);
  ASSERT_FALSE(line);
  EXPECT_EQ(line.error().text(), "cannot open `" + address.text() + "`: Connection refused");
}

}  // namespace
}  // namespace rave::line
