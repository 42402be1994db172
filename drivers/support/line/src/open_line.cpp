// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <utility>

#include "rave/base/descriptor.hpp"
#include "rave/line/byte_line.hpp"

namespace rave::line {
namespace {

tl::unexpected<Error> system_error(const Address& address, int number) {
  const bool missing = number == ENOENT || number == ENXIO || number == ENODEV;
  return fail(missing ? ErrorCode::kNotFound : ErrorCode::kIo, "cannot open `{}`: {}",
              address.text(), std::strerror(number));
}

Status make_raw(const Address& address, int fd) {
  termios mode{};
  if (::tcgetattr(fd, &mode) != 0) return system_error(address, errno);
  ::cfmakeraw(&mode);
  // CLOCAL ignores the modem lines, which many adapters do not connect. Without it open() and
  // write() could block.
  mode.c_cflag |= CLOCAL | CREAD;
  mode.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  mode.c_cc[VMIN] = 1;
  mode.c_cc[VTIME] = 0;
  const speed_t speed = speed_of(address.baud);
  if (::cfsetispeed(&mode, speed) != 0 || ::cfsetospeed(&mode, speed) != 0 ||
      ::tcsetattr(fd, TCSANOW, &mode) != 0 || ::tcflush(fd, TCIOFLUSH) != 0) {
    return system_error(address, errno);
  }
  return {};
}

Result<int> connect_to(const Address& address, const addrinfo& target, HostTime end,
                       const Wake* wake) {
  Descriptor fd(::socket(target.ai_family, target.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (fd.get() < 0) return system_error(address, errno);
  const int yes = 1;
  // Commands are a few bytes. Nagle's algorithm would hold them back for the answer to the ones
  // before.
  ::setsockopt(fd.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  if (::connect(fd.get(), target.ai_addr, target.ai_addrlen) == 0) return fd.release();
  if (errno != EINPROGRESS) return system_error(address, errno);
  const int ready = detail::wait_ready(fd.get(), POLLOUT, end, wake);
  if (ready < 0) return fail(ErrorCode::kState, "closed while connecting");
  if (ready == 0) return fail(ErrorCode::kTimeout, "`{}` does not answer", address.text());
  int error = 0;
  socklen_t size = sizeof error;
  ::getsockopt(fd.get(), SOL_SOCKET, SO_ERROR, &error, &size);
  if (error != 0) return system_error(address, error);
  return fd.release();
}

}  // namespace

Result<int> detail::open_serial(const Address& address) {
  // O_NOCTTY: a serial line must not become the terminal that sends signals to this process.
  Descriptor fd(::open(address.device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (fd.get() < 0) return system_error(address, errno);
  if (::isatty(fd.get()) == 0) {
    return fail(ErrorCode::kInvalidArgument, "`{}` is not a serial line", address.device);
  }
  RAVE_TRY(make_raw(address, fd.get()));
  return fd.release();
}

Result<int> detail::open_tcp(const Address& address, Wait limit, const Wake* wake) {
  const HostTime end = host_now() + limit;
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int status = ::getaddrinfo(address.host.c_str(), address.port.c_str(), &wanted, &found);
  if (status != 0) {
    return fail(ErrorCode::kNotFound, "cannot find the host `{}`: {}", address.host,
                ::gai_strerror(status));
  }
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> targets(found, &::freeaddrinfo);
  Result<int> last = fail(ErrorCode::kNotFound, "`{}` has no address", address.host);
  for (const addrinfo* target = found; target != nullptr && !last; target = target->ai_next) {
    last = connect_to(address, *target, end, wake);
  }
  return last;
}

}  // namespace rave::line
