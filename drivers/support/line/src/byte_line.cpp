// SPDX-License-Identifier: Apache-2.0
#include "rave/line/byte_line.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

namespace rave::line {

int detail::wait_ready(int fd, short events, HostTime end, const Wake* wake) noexcept {
  while (true) {
    std::array<pollfd, 2> wanted{{{fd, events, 0}, {wake != nullptr ? wake->fd() : -1, POLLIN, 0}}};
    const int ready = ::poll(wanted.data(), wanted.size(), static_cast<int>(until(end).count()));
    if (ready < 0 && errno == EINTR) continue;
    // The bell first: closing must not wait behind a line that always has data.
    if (wanted[1].revents != 0) return -1;
    if (ready < 0 || wanted[0].revents != 0) return 1;  // the next call reports an error
    if (host_now() >= end) return 0;
  }
}

Result<ByteLine> ByteLine::open(const Address& address, Wait limit, const Wake* wake) {
  RAVE_TRY_ASSIGN(const int fd, address.is_serial() ? detail::open_serial(address)
                                                    : detail::open_tcp(address, limit, wake));
  return ByteLine(fd);
}

ReadResult ByteLine::lose(std::string why) noexcept {
  lost_ = std::move(why);
  return {ReadEnd::kLost, 0};
}

ReadResult ByteLine::read(std::span<char> room, Wait limit, const Wake* wake) noexcept {
  if (!lost_.empty()) return {ReadEnd::kLost, 0};
  const HostTime end = host_now() + limit;
  while (true) {
    const int ready = detail::wait_ready(fd_.get(), POLLIN, end, wake);
    if (ready < 0) return {ReadEnd::kWoken, 0};
    if (ready == 0) return {ReadEnd::kTimeout, 0};
    const ssize_t size = ::read(fd_.get(), room.data(), room.size());
    if (size > 0) return {ReadEnd::kBytes, static_cast<std::size_t>(size)};
    if (size == 0) return lose("the other end closed the connection");
    if (errno != EAGAIN && errno != EINTR) return lose(std::strerror(errno));
  }
}

Status ByteLine::write(std::string_view bytes, Wait limit, const Wake* wake) {
  const HostTime end = host_now() + limit;
  while (!bytes.empty()) {
    if (!lost_.empty()) return fail(ErrorCode::kIo, "the line is lost: {}", lost_);
    const int ready = detail::wait_ready(fd_.get(), POLLOUT, end, wake);
    if (ready < 0) return fail(ErrorCode::kState, "closed while writing");
    if (ready == 0) return fail(ErrorCode::kTimeout, "the device does not accept data");
    // send() can suppress SIGPIPE, but works for sockets only; a serial line needs write().
    ssize_t size = ::send(fd_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (size < 0 && errno == ENOTSOCK) size = ::write(fd_.get(), bytes.data(), bytes.size());
    if (size > 0) bytes.remove_prefix(static_cast<std::size_t>(size));
    if (size < 0 && errno != EAGAIN && errno != EINTR) lose(std::strerror(errno));
  }
  return {};
}

}  // namespace rave::line
