// SPDX-License-Identifier: Apache-2.0
#include "wire.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <limits>

#include "arguments.hpp"
#include "own_clock.hpp"

namespace peer {
namespace {

constexpr std::size_t kMostPieces = 4096;

void close_fd(int& fd) {
  if (fd >= 0) ::close(fd);
  fd = -1;
}

}  // namespace

Wire::Wire(std::string link, int port, bool tcp) : link_(std::move(link)), port_(port), tcp_(tcp) {
  come_back();
}

Wire::~Wire() { vanish(); }

std::string Wire::name() const { return tcp_ ? std::to_string(port_) : link_; }

void Wire::vanish() {
  if (!tcp_) ::unlink(link_.c_str());
  drop_line();
  close_fd(slave_);
  close_fd(listener_);
}

void Wire::come_back() {
  if (there()) return;
  if (tcp_) {
    listen_on_port();
  } else {
    open_terminal();
  }
}

void Wire::open_terminal() {
  line_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (line_ < 0 || ::grantpt(line_) != 0 || ::unlockpt(line_) != 0) give_up("no pseudo-terminal");
  const std::string path = ::ptsname(line_);
  slave_ = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  termios mode{};
  ::tcgetattr(slave_, &mode);
  ::cfmakeraw(&mode);
  ::tcsetattr(slave_, TCSANOW, &mode);
  // Moved into place, so that a host finds the whole link or none.
  const std::string fresh = link_ + ".new";
  ::unlink(fresh.c_str());
  if (::symlink(path.c_str(), fresh.c_str()) != 0 || ::rename(fresh.c_str(), link_.c_str()) != 0) {
    give_up("cannot make the link " + link_);
  }
}

void Wire::listen_on_port() {
  listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int yes = 1;
  ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in own{};
  own.sin_family = AF_INET;
  own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  own.sin_port = htons(static_cast<std::uint16_t>(port_));
  socklen_t size = sizeof own;
  if (::bind(listener_, reinterpret_cast<sockaddr*>(&own), size) != 0 ||
      ::listen(listener_, 1) != 0 ||
      ::getsockname(listener_, reinterpret_cast<sockaddr*>(&own), &size) != 0) {
    give_up("cannot listen on port " + std::to_string(port_));
  }
  port_ = ntohs(own.sin_port);
}

void Wire::accept_host() {
  const int host = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (host < 0) return;
  drop_line();
  line_ = host;
  const int yes = 1;
  ::setsockopt(line_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
}

void Wire::drop_line() {
  close_fd(line_);
  waiting_.clear();
}

void Wire::send(const std::string& bytes, std::int64_t not_before_ns) {
  // A device does not wait for a host that reads nothing.
  if (line_ < 0 || waiting_.size() >= kMostPieces) return;
  waiting_.push_back({not_before_ns, bytes});
  push_out();
}

std::int64_t Wire::due_ns() const {
  return waiting_.empty() ? std::numeric_limits<std::int64_t>::max()
                          : waiting_.front().not_before_ns;
}

void Wire::push_out() {
  while (line_ >= 0 && !waiting_.empty() && due_ns() <= true_ns()) {
    Piece& piece = waiting_.front();
    const ssize_t size = ::write(line_, piece.bytes.data(), piece.bytes.size());
    if (size < 0) return;
    piece.bytes.erase(0, static_cast<std::size_t>(size));
    if (!piece.bytes.empty()) return;
    waiting_.pop_front();
  }
}

std::string Wire::exchange(std::int64_t until_ns, int other_fd) {
  push_out();
  const std::int64_t now = true_ns();
  const bool blocked = !waiting_.empty() && due_ns() <= now;
  const std::int64_t wake = blocked ? until_ns : std::min(until_ns, due_ns());
  const std::int64_t left_ns = std::clamp<std::int64_t>(wake - now, 0, 1'000'000'000);
  pollfd wanted[3] = {{other_fd, POLLIN, 0},
                      {listener_, POLLIN, 0},
                      {line_, static_cast<short>(blocked ? POLLIN | POLLOUT : POLLIN), 0}};
  const timespec limit{left_ns / 1'000'000'000, left_ns % 1'000'000'000};
  if (::ppoll(wanted, 3, &limit, nullptr) > 0 && wanted[1].revents != 0) accept_host();
  push_out();
  if (line_ < 0 || wanted[2].revents == 0) return {};
  char room[512];
  const ssize_t size = ::read(line_, room, sizeof room);
  if (size > 0) return std::string(room, static_cast<std::size_t>(size));
  if (tcp_ && (size == 0 || errno != EAGAIN)) drop_line();
  return {};
}

}  // namespace peer
