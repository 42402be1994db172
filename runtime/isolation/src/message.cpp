// SPDX-License-Identifier: Apache-2.0
#include "message.hpp"

#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>

namespace rave::isolation {

#if defined(__SANITIZE_THREAD__)
static_assert(kWhereSignal == SIGSYS);
#else
static_assert(kWhereSignal == SIGUSR1);
#endif

bool send_message(int socket, const MessageHead& head, std::string_view text, bool wait) noexcept {
  MessageHead head_copy = head;
  const std::size_t size = std::min(text.size(), kMaxMessageBytes - sizeof head_copy);
  iovec parts[2] = {{&head_copy, sizeof head_copy}, {const_cast<char*>(text.data()), size}};
  msghdr message{};
  message.msg_iov = parts;
  message.msg_iovlen = 2;
  // Without SIGPIPE: the death of the other side is an error here, not the end of this process.
  const int flags = MSG_NOSIGNAL | (wait ? 0 : MSG_DONTWAIT);
  for (;;) {
    if (::sendmsg(socket, &message, flags) >= 0) return true;
    if (errno != EINTR) return false;
  }
}

std::optional<Message> parse_message(std::string_view bytes) noexcept {
  if (bytes.size() < sizeof(MessageHead) || bytes.size() > kMaxMessageBytes) return {};
  // Numbers first, and not the struct with the enumerator: a value outside of it would be undefined
  // behaviour.
  std::uint32_t numbers[3];
  std::memcpy(numbers, bytes.data(), sizeof numbers);
  if (numbers[0] < static_cast<std::uint32_t>(MessageKind::kStarted) ||
      numbers[0] > static_cast<std::uint32_t>(MessageKind::kUpdateRefused)) {
    return {};
  }
  return Message{{static_cast<MessageKind>(numbers[0]), numbers[1], numbers[2]},
                 bytes.substr(sizeof(MessageHead))};
}

Place parse_place(std::string_view text) noexcept {
  Place place;
  const std::size_t line = text.find('\n');
  place.file = text.substr(0, line);
  if (line == std::string_view::npos) return place;
  const std::size_t function = text.find('\n', line + 1);
  const std::size_t line_end = std::min(function, text.size());
  std::from_chars(text.data() + line + 1, text.data() + line_end, place.line);
  if (function == std::string_view::npos) return place;
  const std::size_t frame = text.find('\n', function + 1);
  place.function = text.substr(function + 1, frame - function - 1);
  if (frame != std::string_view::npos) place.frame = text.substr(frame + 1);
  return place;
}

}  // namespace rave::isolation
