// SPDX-License-Identifier: Apache-2.0
#include "rave/line/wake.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "rave/line/host_clock.hpp"

namespace rave::line {

Status Wake::open() {
  if (event_) return {};
  // A descriptor, so that one poll() waits for the line and for the bell.
  event_ = Descriptor(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (!event_) return fail(ErrorCode::kIo, "cannot make an event: {}", std::strerror(errno));
  return {};
}

void Wake::ring() noexcept {
  const std::uint64_t one = 1;
  // Fails only if the counter is full; the bell rings already then.
  [[maybe_unused]] const auto written = ::write(event_.get(), &one, sizeof one);
}

void Wake::clear() noexcept {
  std::uint64_t count = 0;
  [[maybe_unused]] const auto got = ::read(event_.get(), &count, sizeof count);
}

void Wake::end(std::jthread& thread) noexcept {
  if (!thread.joinable()) return;
  thread.request_stop();
  ring();
  thread.join();
}

bool Wake::wait(std::chrono::milliseconds limit) const noexcept {
  const HostTime end = host_now() + limit;
  while (true) {
    pollfd wanted{event_.get(), POLLIN, 0};
    const int ready = ::poll(&wanted, 1, static_cast<int>(until(end).count()));
    if (ready > 0) return true;
    if (ready == 0 || errno != EINTR) return false;
  }
}

}  // namespace rave::line
